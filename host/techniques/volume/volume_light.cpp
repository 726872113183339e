#include "techniques/volume/volume_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh_zonal.h"

namespace prelight {

namespace {

void leaveOutInside(const VolumeTransfer& volume, std::array<VolumeCorner, 8>& corners) {
  double inAir = 0.0;
  for (const VolumeCorner& corner : corners) inAir += volume.air[corner.voxel] != 0 ? corner.weight : 0.0;
  if (inAir < 1e-6) return;
  for (VolumeCorner& corner : corners)
    corner.weight = volume.air[corner.voxel] != 0 ? corner.weight / inAir : 0.0;
}

}  // namespace

VolumeGrid makeVolumeGrid(const CompiledScene& scene, int longest) {
  const glm::dvec3 extent = glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin);
  const double side = std::max({extent.x, extent.y, extent.z, 1e-6});
  const double cell = side / longest;
  VolumeGrid grid;
  for (int a = 0; a < 3; ++a)
    grid.size[a] =
        std::clamp(static_cast<int>(std::ceil(extent[a] / cell - 1e-6)), std::min(2, longest), longest);
  const glm::dvec3 centre = scene.origin + 0.5 * (glm::dvec3(scene.boundsMin) + glm::dvec3(scene.boundsMax));
  grid.min = centre - 0.5 * cell * glm::dvec3(grid.size);
  grid.max = centre + 0.5 * cell * glm::dvec3(grid.size);
  return grid;
}

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

VolumeSample sampleVolume(const VolumeTransfer& volume, const glm::dvec3& position) {
  std::array<VolumeCorner, 8> corners = cornersAt(volume.grid, position);
  leaveOutInside(volume, corners);
  const std::size_t n = volume.columns(), channels = static_cast<std::size_t>(volume.channels);
  VolumeSample sample;
  sample.order = volume.order;
  const auto mix = [&](const std::vector<float>& values, std::size_t width, std::size_t first) {
    std::vector<double> mixed(n, 0.0);
    for (const VolumeCorner& corner : corners)
      for (std::size_t i = 0; i < n; ++i)
        mixed[i] += corner.weight * double(values[corner.voxel * width + first + i]);
    return mixed;
  };
  for (std::size_t c = 0; c < 3; ++c)
    sample.coefficients[c] = mix(volume.coefficients, channels * n, channels == 3 ? c * n : 0);
  sample.direct = volume.direct.empty() ? sample.coefficients[0] : mix(volume.direct, n, 0);
  return sample;
}

glm::dvec3 meanRadiance(const VolumeSample& sample, std::span<const double> light, std::size_t lightColumns) {
  glm::dvec3 radiance(0.0);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < sample.coefficients[c].size(); ++i)
      radiance[static_cast<int>(c)] += light[c * lightColumns + i] * sample.coefficients[c][i];
  return radiance;
}

glm::dvec3 diffuseRadiance(const VolumeSample& sample, const sh::ShProduct& product,
                           std::span<const double> light, const glm::dvec3& normal) {
  const auto n = static_cast<std::size_t>(product.order() * product.order());
  std::vector<double> visibility(sample.direct), arriving(n), cosine(n);
  for (double& v : visibility) v *= 4.0 * std::numbers::pi;
  sh::openTransfer(normal, product.order(), cosine);
  glm::dvec3 radiance(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0.0;
    product.multiply(visibility, light.subspan(c * n, n), arriving);
    for (std::size_t i = 0; i < n; ++i) sum += arriving[i] * cosine[i];
    for (std::size_t i = 0; i < std::min(n, sample.direct.size()); ++i)
      sum += light[c * n + i] * (sample.coefficients[c][i] - sample.direct[i]);
    radiance[static_cast<int>(c)] = sum;
  }
  return radiance;
}

}  // namespace prelight
