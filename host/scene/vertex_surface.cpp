#include "scene/vertex_surface.h"

namespace prelight {

std::vector<double> surfaceOfVertices(const CompiledScene& scene) {
  std::vector<double> areas(scene.vertexCount(), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double third = glm::length(geometricNormal(scene, t)) / 6.0;
    for (int corner = 0; corner < 3; ++corner) areas[scene.triangles[t][corner]] += third;
  }
  return areas;
}

}  // namespace prelight
