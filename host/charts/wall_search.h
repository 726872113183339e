#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds surfaces that stand on or cross the surfaces of a layout between neighbouring texels, such as the
/// wall between two rooms that share a floor, and which texels beside them lie inside objects: sets the
/// layout's `walls`, and `whole` of its texels. Costs about four short rays per texel. `ignored`: [triangle]
/// 1 where a triangle is no wall, because it will move; empty: all may be walls. The tracer must be that of
/// the scene.
void findWalls(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
               std::span<const std::uint8_t> ignored = {});

/// Returns [texel of the layout] the number of the patch on which it lies. Texels of a chart that are
/// connected by steps between neighbours without walls form a patch, whose number is the index of its first
/// texel.
std::vector<std::uint32_t> wallPatches(const LightMapLayout& layout);

}  // namespace prelight
