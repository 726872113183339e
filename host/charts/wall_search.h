#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds what stands on or crosses the surfaces of a layout between neighbouring texels, such as the wall
/// between two rooms that share a floor, and which texels beside it lie inside objects: sets the layout's
/// `walls` and `whole` of its texels. Costs about four short rays per texel. `ignored`: [triangle] 1 where
/// one is no wall, as it will move; empty: all may be. The scene is the one that the tracer was made of.
void findWalls(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
               std::span<const std::uint8_t> ignored = {});

/// [texel of the layout] the number of the patch that it lies on: texels of a chart that no wall parts, in
/// steps from neighbour to neighbour, lie on one patch. Its number is the index of its first texel.
std::vector<std::uint32_t> wallPatches(const LightMapLayout& layout);

}  // namespace prelight
