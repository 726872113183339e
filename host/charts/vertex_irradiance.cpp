#include "charts/vertex_irradiance.h"

#include <algorithm>
#include <cmath>

#include "base/kept_work.h"
#include "charts/light_map_lookup.h"
#include "fit/vertex_fit.h"
#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr double samplesPerTexel = 1.0;
constexpr std::uint32_t leastSamples = 4, mostSamples = 256;  // per triangle
constexpr std::uint32_t trianglesAtOnce = 1024;               // between two tests for interruption

/// Samples a map over all triangles for a fit of `each` of its coefficients, from `first` on.
class MapSampler {
 public:
  MapSampler(const CompiledScene& scene, const LightMap& map, int first, std::size_t each)
      : map_(map), first_(first), each_(each), areas_(scene.triangleCount()), values_(3 * each) {
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      areas_[t] = 0.5 * glm::length(geometricNormal(scene, t));
      meanArea_ += areas_[t] / scene.triangleCount();
    }
  }

  void addTriangle(std::uint32_t t, VertexFit& fit) {
    if (map_.layout.chartOf[t] == LightMapLayout::noChart) return;
    const auto wanted = static_cast<std::uint32_t>(
        std::clamp(samplesPerTexel * texelsOf(map_.layout, t), double(leastSamples), double(mostSamples)));
    for (std::uint32_t i = 0; i < wanted; ++i) {
      const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, sampling::hashInteger(t)));
      const SurfaceSample sample{t, static_cast<float>(b.x), static_cast<float>(b.y),
                                 static_cast<float>(areas_[t] / meanArea_ / wanted)};
      const LightMapLookUp at = lookUp(map_, lightMapPlace(map_.layout, t, b.x, b.y));
      for (std::size_t k = 0; k < each_; ++k) {
        const glm::dvec3 value = lightMapValue(map_, at, first_ + static_cast<int>(k));
        for (std::size_t c = 0; c < 3; ++c) values_[c * each_ + k] = value[static_cast<int>(c)];
      }
      fit.add(sample, values_);
    }
  }

 private:
  const LightMap& map_;
  int first_;
  std::size_t each_;
  double meanArea_ = 0.0;
  std::vector<double> areas_, values_;
};

/// Returns `count` coefficients of a map, from `first` on, fitted to vertices: [shared
/// vertex][channel][coefficient].
std::vector<float> fitToVertices(const CompiledScene& scene, const FitMesh& mesh, const LightMap& map,
                                 int first, int count, const Progress& progress) {
  const auto each = static_cast<std::size_t>(count);
  VertexFit fit(mesh, 3 * each);
  {
    MapSampler sampler(scene, map, first, each);
    std::uint32_t done = 0;
    WorkPart part(progress, "samples of the map", [&](auto& state) {
      state.value(done);
      keptBy(fit)(state);
    });
    while (done < scene.triangleCount()) {
      progress.check();
      const std::uint32_t end = std::min(done + trianglesAtOnce, scene.triangleCount());
      for (; done < end; ++done) sampler.addTriangle(done, fit);
      part.advance();
    }
    part.finish();
  }
  return fit.solve(defaultSmoothing, {.progress = &progress});
}

}  // namespace

std::vector<glm::vec3> irradianceOfVertices(const CompiledScene& scene, const FitMesh& mesh,
                                            const LightMap& map, const Progress& progress) {
  const std::vector<float> solved = fitToVertices(scene, mesh, map, 0, 1, progress);
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(scene.vertexCount());
  for (const std::uint32_t slot : mesh.slotOfVertex) {
    const float* value = &solved[3 * std::size_t{slot}];
    irradiance.push_back(glm::max(glm::vec3(value[0], value[1], value[2]), 0.0f));
  }
  return irradiance;
}

std::vector<float> incidentOfVertices(const CompiledScene& scene, const FitMesh& mesh, const LightMap& map,
                                      const Progress& progress) {
  const auto length = 3 * static_cast<std::size_t>(map.coefficients - 1);
  const std::vector<float> solved = fitToVertices(scene, mesh, map, 1, map.coefficients - 1, progress);
  std::vector<float> incident;
  incident.reserve(length * scene.vertexCount());
  for (const std::uint32_t slot : mesh.slotOfVertex)
    for (std::size_t i = 0; i < length; ++i) incident.push_back(solved[length * slot + i]);
  return incident;
}

}  // namespace prelight
