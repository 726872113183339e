#pragma once

#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"
#include "shared/density_types.h"

namespace prelight {

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
