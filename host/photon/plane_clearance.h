#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/surface_regions.h"

namespace prelight {

/// [triangle] how wide a disc about any of its points in its plane may be and still lie within its region, m,
/// at least: the area of such a disc needs no look at triangles. 0 for regions that are not planar (`planar`
/// [region] is 0), for triangles at their region's rim, and for regions whose rim is too long to look at.
std::vector<float> planeClearance(const CompiledScene& scene, const SurfaceRegions& regions,
                                  std::span<const std::uint8_t> planar);

}  // namespace prelight
