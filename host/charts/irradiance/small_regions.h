#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Returns the share by which the density of photons at each texel of a layout counts, [texel of the layout]:
/// 1, but less where a texel stands for more surface than the region whose photons it counts. The photons of
/// such a region light a part of the texel alone, and few as they are, their density may be that of a lamp's
/// surface.
std::vector<float> sharesOfRegions(const CompiledScene& scene, std::span<const std::uint32_t> regionOf,
                                   const LightMapLayout& layout);

/// Returns the approximate distance of neighbouring texels, m.
double texelSpacing(const CompiledScene& scene, const LightMapLayout& layout);

}  // namespace prelight
