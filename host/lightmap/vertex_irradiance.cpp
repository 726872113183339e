#include "lightmap/vertex_irradiance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/vertex_fit.h"
#include "lightmap/light_map_lookup.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr double samplesPerTexel = 1.0;
constexpr std::uint32_t leastSamples = 4, mostSamples = 256;  // of a triangle

}  // namespace

std::vector<glm::vec3> irradianceOfVertices(const CompiledScene& scene, const FitMesh& mesh,
                                            const LightMap& map) {
  VertexFit fit(mesh, 3);
  double meanArea = 0.0;
  std::vector<double> areas(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    areas[t] = 0.5 * glm::length(geometricNormal(scene, t));
    meanArea += areas[t] / scene.triangleCount();
  }
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    if (map.layout.chartOf[t] == LightMapLayout::noChart) continue;
    const auto wanted = static_cast<std::uint32_t>(
        std::clamp(samplesPerTexel * texelsOf(map.layout, t), double(leastSamples), double(mostSamples)));
    for (std::uint32_t i = 0; i < wanted; ++i) {
      const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, sampling::hashInteger(t)));
      const SurfaceSample sample{t, static_cast<float>(b.x), static_cast<float>(b.y),
                                 static_cast<float>(areas[t] / meanArea / wanted)};
      const glm::dvec3 e = lightMapIrradiance(map, t, b.x, b.y);
      fit.add(sample, std::array<double, 3>{e.x, e.y, e.z});
    }
  }
  const std::vector<double> solved = fit.solve(defaultSmoothing);
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(scene.vertexCount());
  for (const std::uint32_t slot : mesh.slotOfVertex) {
    const double* value = &solved[3 * std::size_t{slot}];
    irradiance.emplace_back(glm::max(glm::dvec3(value[0], value[1], value[2]), 0.0));
  }
  return irradiance;
}

}  // namespace prelight
