#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/surface_regions.h"

namespace prelight {

/// Returns for each triangle, [triangle], a radius in m: a disc of this radius in the triangle's plane about
/// any of its points lies within its region, so that its area is known without visiting triangles. It is 0
/// for regions that are not planar (`planar`, [region], is 0), for triangles at their region's rim, and for
/// regions whose rim is too long to search.
std::vector<float> planeClearance(const CompiledScene& scene, const SurfaceRegions& regions,
                                  std::span<const std::uint8_t> planar);

}  // namespace prelight
