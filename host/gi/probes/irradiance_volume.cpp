#include "gi/probes/irradiance_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/directions.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "techniques/volume/volume_light.h"

namespace prelight {

namespace {

constexpr int side = IrradianceVolume::surfaceSide;

/// Returns the index of a texel. A texel beyond an edge of the octahedral map is mirrored about the middle of
/// that edge.
std::size_t surfaceTexel(int x, int y) {
  if (x < 0 || x >= side) y = side - 1 - y;
  if (y < 0 || y >= side) x = side - 1 - x;
  return static_cast<std::size_t>(std::clamp(y, 0, side - 1) * side + std::clamp(x, 0, side - 1));
}

}  // namespace

bool probeSees(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& point) {
  const glm::dvec3 way = point - glm::dvec3(volume.places[probe]);
  const double tolerance = 1e-3 * volume.grid.cell();
  if (glm::length(way) <= tolerance) return true;
  const glm::ivec2 low(glm::floor(octahedralPlace(way) * static_cast<double>(side) - 0.5));
  for (int i = 0; i < 4; ++i) {
    const glm::dvec4 surface(
        volume.surfaces[probe * side * side + surfaceTexel(low.x + i % 2, low.y + i / 2)]);
    if (glm::dot(glm::dvec3(surface), way) + surface.w < -tolerance) return false;
  }
  return true;
}

glm::dvec3 probeIrradiance(const IrradianceVolume& volume, std::size_t probe, const glm::dvec3& normal) {
  std::array<double, 9> values{};
  const std::size_t columns = volume.columns();
  sh::evaluate(normal, volume.order, std::span(values).first(columns));
  glm::dvec3 sum(0.0);
  for (int l = 0, i = 0; l < volume.order; ++l)
    for (int m = -l; m <= l; ++m, ++i)
      for (int c = 0; c < 3; ++c)
        sum[c] +=
            std::numbers::pi * sh::clampedCosine(l) * values[static_cast<std::size_t>(i)] *
            static_cast<double>(volume.coefficients[3 * (probe * columns + static_cast<std::size_t>(i)) +
                                                    static_cast<std::size_t>(c)]);
  return sum;
}

glm::dvec3 irradianceAt(const IrradianceVolume& volume, const glm::dvec3& point, const glm::dvec3& normal) {
  std::array<VolumeCorner, 8> corners = cornersAt(volume.grid, point);
  std::array<double, 8> seen{};
  double valid = 0.0, visible = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (volume.valid[corners[i].voxel] == 0) corners[i].weight = 0.0;
    seen[i] = probeSees(volume, corners[i].voxel, point) ? corners[i].weight : 0.0;
    valid += corners[i].weight;
    visible += seen[i];
  }
  constexpr double least = 1e-6;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 8; ++i) {
    const double weight = visible > least ? seen[i] / visible : corners[i].weight / std::max(valid, least);
    if (weight > 0.0) sum += weight * probeIrradiance(volume, corners[i].voxel, normal);
  }
  return glm::max(sum, 0.0);
}

}  // namespace prelight
