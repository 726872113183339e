#include "transfer/volume_cells.h"

#include <algorithm>

namespace prelight {

glm::dvec3 voxelCentre(const VolumeGrid& grid, std::size_t voxel) {
  const auto i = static_cast<int>(voxel);
  const glm::ivec3 cell(i % grid.size.x, i / grid.size.x % grid.size.y, i / (grid.size.x * grid.size.y));
  return grid.min + grid.cell() * (glm::dvec3(cell) + 0.5);
}

std::array<VolumeCorner, 8> cornersAt(const VolumeGrid& grid, const glm::dvec3& position) {
  const glm::dvec3 at = (position - grid.min) / grid.cell() - 0.5;
  glm::ivec3 low(0), high(0);
  glm::dvec3 share(0.0);
  for (int a = 0; a < 3; ++a) {
    const double inside = std::clamp(at[a], 0.0, grid.size[a] - 1.0);
    low[a] = static_cast<int>(inside);
    high[a] = std::min(low[a] + 1, grid.size[a] - 1);
    share[a] = inside - low[a];
  }
  std::array<VolumeCorner, 8> corners{};
  for (unsigned k = 0; k < 8; ++k) {
    double weight = 1.0;
    glm::ivec3 cell(0);
    for (int a = 0; a < 3; ++a) {
      const bool upper = (k >> a & 1u) != 0;
      cell[a] = upper ? high[a] : low[a];
      weight *= upper ? share[a] : 1.0 - share[a];
    }
    corners[k] = {static_cast<std::size_t>((cell.z * grid.size.y + cell.y) * grid.size.x + cell.x), weight};
  }
  return corners;
}

}  // namespace prelight
