#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/surface/surface_regions.h"
#include "shared/density_types.h"

namespace prelight {

/// Returns for each triangle, [triangle], a radius in m: a disc of this radius in the triangle's plane about
/// any of its points lies within its region, so that its area is known without visiting triangles. It is 0
/// for regions that are not planar (`planar`, [region], is 0), for triangles at their region's rim, and for
/// regions whose rim is too long to search.
std::vector<float> planeClearance(const CompiledScene& scene, const SurfaceRegions& regions,
                                  std::span<const std::uint8_t> planar);

/// Surface data of density estimation: the region of each triangle, and trees that measure how much area of a
/// region lies around a point. Plain data for the device, made once per scene.
struct DensitySurface {
  std::vector<device::SurfacePlace> places;     ///< [triangle]
  std::vector<device::LeafTree> areaTrees;      ///< [region]
  std::vector<device::AreaNode> areaNodes;      ///< [node of all trees]
  std::vector<device::AreaTriangle> triangles;  ///< [leaf of all trees][PRELIGHT_LEAF_TRIANGLES]
  std::uint32_t regionCount() const { return static_cast<std::uint32_t>(areaTrees.size()); }
};

/// Makes the data. A region counts as planar if the distances of its vertices from the plane are within the
/// rounding of coordinates.
DensitySurface makeDensitySurface(const CompiledScene& scene, const SurfaceRegions& regions);

/// Updates regions whose triangles have moved together as rigid bodies to the scene's present positions.
void followDensitySurface(DensitySurface& surface, const CompiledScene& scene,
                          std::span<const std::uint32_t> regions);

}  // namespace prelight
