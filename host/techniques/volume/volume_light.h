#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "basis/sh_products.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Returns a grid around a scene's bounds with `longest` cells along the longest side and at least two along
/// each (one if `longest` is 1), so that no flat scene lies in a layer of centres.
VolumeGrid makeVolumeGrid(const CompiledScene& scene, int longest);

/// A cell of a volume near a point, with its weight in interpolation.
struct VolumeCorner {
  std::size_t voxel = 0;
  double weight = 0.0;
};

/// Returns the centre of a cell in world space.
glm::dvec3 voxelCentre(const VolumeGrid& grid, std::size_t voxel);

/// Returns the eight cells around a point with trilinear weights. At the volume's faces, a cell may occur
/// several times.
std::array<VolumeCorner, 8> cornersAt(const VolumeGrid& grid, const glm::dvec3& position);

/// Returns irradiance over pi of a diffuse point with a unit normal, for objects that move through the volume
/// (their exit radiance is albedo times this). It is approximate: direct light is the product of visibility
/// and light, both truncated to the product's orders, under the clamped cosine; light reflected by surfaces
/// is assumed to arrive uniformly from all sides. `product` must have the light's order as order() and the
/// sample's as fOrder().
glm::dvec3 diffuseRadiance(const VolumeSample& sample, const sh::ShProduct& product,
                           std::span<const double> light, const glm::dvec3& normal);

}  // namespace prelight
