#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "prelight/transfer.h"

namespace prelight {

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

}  // namespace prelight
