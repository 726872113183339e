#include "gi/small_regions.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scene/surface/triangles.h"

namespace prelight {

void lessenSmallRegions(const CompiledScene& scene, const DensitySurface& surface,
                        const LightMapLayout& layout, double spacing, std::span<glm::vec3> irradiance) {
  constexpr double rounding = 0.99;  // of areas that are the same
  std::vector<double> regions(surface.regionCount(), 0.0), charts;
  const auto regionOf = [&](std::uint32_t triangle) {
    return surface.places[triangle].region & ~PRELIGHT_PLANAR_REGION;
  };
  for (std::uint32_t face = 0; face < layout.chartOf.size(); ++face) {
    const std::uint32_t triangle = face % scene.triangleCount(), chart = layout.chartOf[face];
    const double area = 0.5 * glm::length(geometricNormal(scene, triangle));
    if (face == triangle) regions[regionOf(triangle)] += area;
    if (chart == LightMapLayout::noChart) continue;
    charts.resize(std::max<std::size_t>(charts.size(), chart + 1), 0.0);
    charts[chart] += area;
  }
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const std::uint32_t face = layout.texels[i].face;
    const double covered = std::min(spacing * spacing, charts[layout.chartOf[face]]),
                 region = regions[regionOf(face % scene.triangleCount())];
    if (region < rounding * covered) irradiance[i] *= static_cast<float>(region / covered);
  }
}

}  // namespace prelight
