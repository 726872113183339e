#include "charts/irradiance/small_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/surface/triangles.h"

namespace prelight {
namespace {

double areaOf(const CompiledScene& scene, std::uint32_t face) {
  return 0.5 * glm::length(geometricNormal(scene, face % scene.triangleCount()));
}

/// Returns the areas of charts, m2, [chart].
std::vector<double> chartAreas(const CompiledScene& scene, const LightMapLayout& layout) {
  std::vector<double> areas;
  for (std::uint32_t face = 0; face < layout.chartOf.size(); ++face) {
    const std::uint32_t chart = layout.chartOf[face];
    if (chart == LightMapLayout::noChart) continue;
    areas.resize(std::max<std::size_t>(areas.size(), chart + 1), 0.0);
    areas[chart] += areaOf(scene, face);
  }
  return areas;
}

}  // namespace

std::vector<float> sharesOfRegions(const CompiledScene& scene, std::span<const std::uint32_t> regionOf,
                                   const LightMapLayout& layout) {
  constexpr double rounding = 0.99;  // of areas that are the same
  std::vector<double> regions(1 + std::ranges::max(regionOf), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) regions[regionOf[t]] += areaOf(scene, t);
  const std::vector<double> charts = chartAreas(scene, layout);
  const double spacing = texelSpacing(scene, layout);
  std::vector<float> shares;
  shares.reserve(layout.texels.size());
  for (const LightMapTexel& texel : layout.texels) {
    const double covered = std::min(spacing * spacing, charts[layout.chartOf[texel.face]]),
                 region = regions[regionOf[texel.face % scene.triangleCount()]];
    shares.push_back(region < rounding * covered ? static_cast<float>(region / covered) : 1.0f);
  }
  return shares;
}

double texelSpacing(const CompiledScene& scene, const LightMapLayout& layout) {
  double area = 0.0;
  for (std::uint32_t face = 0; face < layout.chartOf.size(); ++face)
    if (layout.chartOf[face] != LightMapLayout::noChart) area += areaOf(scene, face);
  return std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, layout.texels.size())));
}

}  // namespace prelight
