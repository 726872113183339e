#include "charts/vertex_irradiance.h"

#include <algorithm>
#include <cmath>

#include "charts/light_map_lookup.h"
#include "fit/vertex_fit.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr double samplesPerTexel = 1.0;
constexpr std::uint32_t leastSamples = 4, mostSamples = 256;  // of a triangle

/// `count` coefficients of a map from `first` on, fitted to vertices: [slot][channel][coefficient].
std::vector<float> fitToVertices(const CompiledScene& scene, const FitMesh& mesh, const LightMap& map,
                                 int first, int count) {
  const auto each = static_cast<std::size_t>(count);
  VertexFit fit(mesh, 3 * each);
  double meanArea = 0.0;
  std::vector<double> areas(scene.triangleCount()), values(3 * each);
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
      const LightMapLookUp at = lookUp(map, lightMapPlace(map.layout, t, b.x, b.y));
      for (std::size_t k = 0; k < each; ++k) {
        const glm::dvec3 value = lightMapValue(map, at, first + static_cast<int>(k));
        for (std::size_t c = 0; c < 3; ++c) values[c * each + k] = value[static_cast<int>(c)];
      }
      fit.add(sample, values);
    }
  }
  return fit.solve(defaultSmoothing);
}

}  // namespace

std::vector<glm::vec3> irradianceOfVertices(const CompiledScene& scene, const FitMesh& mesh,
                                            const LightMap& map) {
  const std::vector<float> solved = fitToVertices(scene, mesh, map, 0, 1);
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(scene.vertexCount());
  for (const std::uint32_t slot : mesh.slotOfVertex) {
    const float* value = &solved[3 * std::size_t{slot}];
    irradiance.push_back(glm::max(glm::vec3(value[0], value[1], value[2]), 0.0f));
  }
  return irradiance;
}

std::vector<float> incidentOfVertices(const CompiledScene& scene, const FitMesh& mesh, const LightMap& map) {
  const auto length = 3 * static_cast<std::size_t>(map.coefficients - 1);
  const std::vector<float> solved = fitToVertices(scene, mesh, map, 1, map.coefficients - 1);
  std::vector<float> incident;
  incident.reserve(length * scene.vertexCount());
  for (const std::uint32_t slot : mesh.slotOfVertex)
    for (std::size_t i = 0; i < length; ++i) incident.push_back(solved[length * slot + i]);
  return incident;
}

}  // namespace prelight
