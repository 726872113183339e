#include "benchmarks/lab/photon_grid.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/lab/lab_kernels.h"
#include "bvh/binary_bvh.h"

namespace prelight::benchmarks {

namespace {

using namespace device;

/// Returns the grid of a map of `count` photons within a box.
PhotonGrid gridOver(const Box& box, std::size_t count, double photonsPerCell, double cellSize) {
  const glm::dvec3 size = glm::max(glm::dvec3(box.upper) - glm::dvec3(box.lower), glm::dvec3(0.0));
  const double largest = std::max({size.x, size.y, size.z, 1e-30});
  double measure = 1.0;
  int dimensions = 0;
  for (int k = 0; k < 3; ++k)
    if (size[k] > 1e-3 * largest) {
      measure *= size[k];
      ++dimensions;
    }
  const double even =
      std::pow(measure * photonsPerCell / static_cast<double>(count), 1.0 / std::max(dimensions, 1));
  const double least = std::pow(measure / (16.0 * static_cast<double>(count)), 1.0 / std::max(dimensions, 1));
  const double cell = std::max(cellSize > 0.0 ? cellSize : even, least);
  PhotonGrid grid{{box.lower.x, box.lower.y, box.lower.z}, static_cast<float>(1.0 / cell), {}, 0};
  for (int k = 0; k < 3; ++k) grid.cells[k] = static_cast<std::uint32_t>(size[k] / cell) + 1u;
  return grid;
}

std::uint32_t cellOf(const PhotonGrid& grid, const Photon& photon) {
  std::uint32_t at[3];
  for (int k = 0; k < 3; ++k)
    at[k] = std::min(
        static_cast<std::uint32_t>(std::max(0.0f, (photon.position[k] - grid.lower[k]) * grid.perCell)),
        grid.cells[k] - 1u);
  return grid.firstCell + (at[2] * grid.cells[1] + at[1]) * grid.cells[0] + at[0];
}

}  // namespace

PhotonGridEstimator::PhotonGridEstimator(const DensitySurface& surface, int nearest, const Device& device)
    : surface_(surface),
      device_(device.context()),
      parameters_(device_, 1),
      maps_(surface, {.nearest = nearest}, device) {
  values_ = maps_.parameters();
  BuildOptions options;
  DensityEstimator::addOptions(options, {.nearest = nearest});
  estimate_ = {device_, labKernel(device_, "grid_kernels.cl"), options, "estimateFromGrid"};
}

void PhotonGridEstimator::setPhotons(std::span<const Photon> photons, double photonsPerCell,
                                     double cellSize) {
  const auto regionOf = [&](const Photon& p) {
    return surface_.places[p.triangle].region & ~PRELIGHT_PLANAR_REGION;
  };
  std::vector<Box> boxes(surface_.regionCount());
  std::vector<std::size_t> counts(surface_.regionCount());
  for (const Photon& p : photons) {
    boxes[regionOf(p)].grow({p.position[0], p.position[1], p.position[2]});
    ++counts[regionOf(p)];
  }
  std::vector<PhotonGrid> grids;
  std::uint32_t cellCount = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    PhotonGrid grid{{}, 1.0f, {1, 1, 1}, 0};
    if (counts[r] > 0) grid = gridOver(boxes[r], counts[r], photonsPerCell, cellSize);
    grid.firstCell = cellCount;
    cellCount += grid.cells[0] * grid.cells[1] * grid.cells[2];
    grids.push_back(grid);
  }
  std::vector<std::uint32_t> cellOfPhoton, starts(cellCount + 1);
  cellOfPhoton.reserve(photons.size());
  for (const Photon& p : photons) {
    cellOfPhoton.push_back(cellOf(grids[regionOf(p)], p));
    ++starts[cellOfPhoton.back() + 1];
  }
  for (std::size_t cell = 0; cell < cellCount; ++cell) starts[cell + 1] += starts[cell];
  const std::size_t length = photons.size() + 8;
  std::vector<float> members(6 * length);
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const std::uint32_t slot = next[cellOfPhoton[i]]++;
    for (std::size_t k = 0; k < 3; ++k) {
      members[k * length + slot] = photons[i].position[k];
      members[(3 + k) * length + slot] = photons[i].power[k];
    }
  }
  grids_ = Buffer<PhotonGrid>(device_, std::span<const PhotonGrid>(grids));
  starts_ = Buffer<std::uint32_t>(device_, std::span<const std::uint32_t>(starts));
  members_ = Buffer<float>(device_, std::span<const float>(members));
  memberLength_ = static_cast<std::uint32_t>(length);
}

void PhotonGridEstimator::estimate(const Buffer<DensityQuery>& queries, std::size_t count,
                                   Buffer<float>& irradiance) {
  values_.queryCount = static_cast<std::uint32_t>(count);
  parameters_.write(std::span<const DensityParameters>(&values_, 1));
  estimate_.launch({count, 16}, parameters_, maps_.lines(), grids_, starts_, members_, memberLength_, queries,
                   irradiance);
}

}  // namespace prelight::benchmarks
