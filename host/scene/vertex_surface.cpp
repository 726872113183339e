#include "scene/vertex_surface.h"

#include <algorithm>
#include <numeric>

namespace prelight {

namespace {

constexpr double leastShare = 1e-12;  // share of the mean

}  // namespace

std::vector<double> surfaceOfVertices(const CompiledScene& scene) {
  std::vector<double> areas(scene.vertexCount(), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double third = glm::length(geometricNormal(scene, t)) / 6.0;
    for (int corner = 0; corner < 3; ++corner) areas[scene.triangles[t][corner]] += third;
  }
  return areas;
}

std::vector<double> positiveSurfaceOfVertices(const CompiledScene& scene) {
  std::vector<double> areas = surfaceOfVertices(scene);
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double least = sum > 0.0 ? leastShare * sum / static_cast<double>(areas.size()) : 1.0;
  for (double& area : areas) area = std::max(area, least);
  return areas;
}

}  // namespace prelight
