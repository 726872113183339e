#include "photon/importance_map.h"

#include <algorithm>
#include <cmath>

#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr std::uint32_t side = 32;
constexpr std::size_t areaPoints = 1 << 16;  ///< points that sample the surface area in each cube
/// Number of importons at which a cube's own density weighs as much as that around it.
constexpr double trusted = 8.0;

/// Returns points that are evenly distributed over the surface, each representing the same area.
std::vector<LandedImporton> pointsOfArea(const CompiledScene& scene) {
  std::vector<double> sums;
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    sums.push_back(area += 0.5 * glm::length(geometricNormal(scene, t)));
  std::vector<LandedImporton> points;
  for (std::size_t i = 0; i < areaPoints && area > 0.0; ++i) {
    const double wanted = (static_cast<double>(i) + 0.5) / areaPoints * area;
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, wanted);
    const glm::uvec3& v = scene.triangles[static_cast<std::size_t>(found - sums.begin())];
    const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(static_cast<std::uint32_t>(i), 0));
    points.push_back({(1.0 - b.x - b.y) * glm::dvec3(scene.positions[v.x]) +
                          b.x * glm::dvec3(scene.positions[v.y]) + b.y * glm::dvec3(scene.positions[v.z]),
                      area / areaPoints});
  }
  return points;
}

/// Returns sums over cubes of twice the size.
std::vector<double> joined(std::span<const double> cubes, std::size_t n) {
  const std::size_t half = n / 2;
  std::vector<double> sums(half * half * half, 0.0);
  for (std::size_t z = 0; z < n; ++z)
    for (std::size_t y = 0; y < n; ++y)
      for (std::size_t x = 0; x < n; ++x)
        sums[((z / 2) * half + y / 2) * half + x / 2] += cubes[(z * n + y) * n + x];
  return sums;
}

/// Returns the densities of n^3 cubes. Each cube counts `prior` of additional power, on the area that this
/// takes at the density of the larger cube around it.
std::vector<double> densities(std::span<const double> power, std::span<const double> area, std::size_t n,
                              double prior) {
  if (n == 1) return {area[0] > 0.0 ? power[0] / area[0] : 0.0};
  const std::vector<double> around = densities(joined(power, n), joined(area, n), n / 2, prior);
  std::vector<double> found(n * n * n);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t x = i % n, y = i / n % n, z = i / (n * n), half = n / 2;
    const double outer = around[((z / 2) * half + y / 2) * half + x / 2];
    found[i] = outer > 0.0 ? (power[i] + prior) / (area[i] + prior / outer) : 0.0;
  }
  return found;
}

}  // namespace

ImportanceMap::ImportanceMap(const CompiledScene& scene, std::span<const LandedImporton> importons) {
  const glm::dvec3 lower(scene.boundsMin), extent = glm::dvec3(scene.boundsMax) - lower;
  for (int k = 0; k < 3; ++k) grid_.lower[k] = scene.boundsMin[k];
  grid_.side = side;
  const double longest = std::max({extent.x, extent.y, extent.z, 1e-30});
  grid_.cellsPerMetre = static_cast<float>(side / longest);
  double power = 0.0;
  for (const LandedImporton& importon : importons) power += importon.power;
  const double prior = trusted * power / std::max<double>(1.0, static_cast<double>(importons.size()));
  values_ = densities(gathered(importons), gathered(pointsOfArea(scene)), side, prior);
}

std::size_t ImportanceMap::cellOf(const glm::dvec3& position) const {
  std::size_t cell = 0;
  for (int k = 2; k >= 0; --k) {
    const double at = (position[k] - double{grid_.lower[k]}) * double{grid_.cellsPerMetre};
    cell = cell * side + static_cast<std::size_t>(std::clamp(at, 0.0, side - 1.0));
  }
  return cell;
}

std::vector<double> ImportanceMap::gathered(std::span<const LandedImporton> points) const {
  std::vector<double> sums(std::size_t{side} * side * side, 0.0);
  for (const LandedImporton& point : points) sums[cellOf(point.position)] += point.power;
  return sums;
}

}  // namespace prelight
