#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "prelight/transfer.h"

namespace prelight {

/// A cell of a volume near a point, and its share in what is interpolated there.
struct VolumeCorner {
  std::size_t voxel = 0;
  double weight = 0.0;
};

/// Middle of a cell, world space.
glm::dvec3 voxelCentre(const VolumeGrid& grid, std::size_t voxel);

/// The eight cells around a point, of trilinear weights; a cell may be there more than once at the volume's
/// faces.
std::array<VolumeCorner, 8> cornersAt(const VolumeGrid& grid, const glm::dvec3& position);

}  // namespace prelight
