#include "refine/largest_instance.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

double areaInSpace(const Primitive& primitive, const glm::dmat3& toWorld) {
  double area = 0.0;
  for (const glm::uvec3& t : primitive.triangles) {
    const glm::dvec3 a(primitive.positions[t.x]), b(primitive.positions[t.y]), c(primitive.positions[t.z]);
    area += 0.5 * glm::length(glm::cross(toWorld * (b - a), toWorld * (c - a)));
  }
  return area;
}

/// Returns the factor by which a skin scales the lengths of an instance beyond its transform.
double skinScale(const Scene& scene, const CompiledScene& compiled, const MeshNode& node,
                 std::size_t instance, const glm::dmat3& toWorld) {
  const std::vector<Primitive>& primitives = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  double posed = 0.0, own = 0.0;
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.node != node.node || range.instance != static_cast<int>(instance)) continue;
    posed += instanceArea(compiled, range);
    own += areaInSpace(primitives[static_cast<std::size_t>(range.primitive)], toWorld);
  }
  return own > 0.0 ? std::sqrt(posed / own) : 1.0;
}

double longestColumn(const glm::dmat3& matrix) {
  return std::max({glm::length(matrix[0]), glm::length(matrix[1]), glm::length(matrix[2])});
}

}  // namespace

double instanceArea(const CompiledScene& compiled, const PrimitiveRange& range) {
  double area = 0.0;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
    area += 0.5 * glm::length(geometricNormal(compiled, t));
  return area;
}

std::optional<glm::dmat3> largestInstance(const Scene& scene, const CompiledScene& compiled,
                                          std::size_t mesh) {
  std::optional<glm::dmat3> largest;
  for (const MeshNode& node : scene.meshNodes) {
    if (node.mesh != static_cast<int>(mesh)) continue;
    for (std::size_t i = 0; i < node.transforms.size(); ++i) {
      glm::dmat3 toWorld(node.transforms[i]);
      if (node.skin >= 0) toWorld *= skinScale(scene, compiled, node, i, toWorld);
      if (!largest || longestColumn(toWorld) > longestColumn(*largest)) largest = toWorld;
    }
  }
  return largest;
}

}  // namespace prelight
