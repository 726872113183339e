#pragma once

#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"
#include "shared/density_types.h"

namespace prelight {

/// What density estimation knows of the surface that photons land on: whose region a triangle is of, and how
/// much of a region lies around a point. Plain data for the device, made once a scene.
struct DensitySurface {
  std::vector<device::SurfacePlace> places;     ///< [triangle]
  std::vector<device::LeafTree> areaTrees;      ///< [region]
  std::vector<device::AreaNode> areaNodes;      ///< [node of all trees]
  std::vector<device::AreaTriangle> triangles;  ///< [leaf of all trees][PRELIGHT_LEAF_TRIANGLES]
  std::uint32_t regionCount() const { return static_cast<std::uint32_t>(areaTrees.size()); }
};

/// A region lies in a plane where no vertex is further from it than rounding of its coordinates explains.
DensitySurface makeDensitySurface(const CompiledScene& scene, const SurfaceRegions& regions);

/// Takes regions whose triangles have moved together, as rigid bodies, to where the scene has them now.
void followDensitySurface(DensitySurface& surface, const CompiledScene& scene,
                          std::span<const std::uint32_t> regions);

}  // namespace prelight
