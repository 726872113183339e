#include "refine/coarse_triangles.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight {

namespace {

constexpr double largeShare = 0.01;  // of the scene's surface
/// Height above a triangle, in lengths of its longest edge, from which on something lies in front of it.
constexpr double leastHeight = 1e-3;

double longestEdge(const CompiledScene& scene, std::uint32_t triangle) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
  return std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}

/// Returns whether a vertex of the scene lies in front of a triangle, no farther away than it is long.
bool hasSomethingInFront(const CompiledScene& scene, std::uint32_t triangle, double edge) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 normal = glm::normalize(geometricNormal(scene, triangle)), centre = (a + b + c) / 3.0;
  const bool bothSides = scene.materials[scene.triangleMaterials[triangle]].doubleSided;
  return std::any_of(scene.positions.begin(), scene.positions.end(), [&](const glm::vec3& position) {
    const glm::dvec3 to = glm::dvec3(position) - centre;
    const double height = glm::dot(to, normal);
    return (bothSides ? std::abs(height) : height) > leastHeight * edge && glm::dot(to, to) < edge * edge;
  });
}

}  // namespace

std::vector<CoarsePrimitive> findCoarsePrimitives(const CompiledScene& scene) {
  std::vector<double> areas(scene.triangleCount());
  double all = 0.0;
  for (std::uint32_t t = 0; t < areas.size(); ++t)
    all += areas[t] = 0.5 * glm::length(geometricNormal(scene, t));
  std::vector<CoarsePrimitive> coarse;
  for (std::uint32_t p = 0; p < scene.primitives.size(); ++p) {
    const PrimitiveRange& range = scene.primitives[p];
    CoarsePrimitive worst{p};
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      if (!(areas[t] > std::max(largeShare, worst.share) * all)) continue;
      const double edge = longestEdge(scene, t);
      if (scene.materials[scene.triangleMaterials[t]].unlit || !hasSomethingInFront(scene, t, edge)) continue;
      worst = {p, edge, areas[t] / all};
    }
    if (worst.edge > 0.0) coarse.push_back(worst);
  }
  std::stable_sort(coarse.begin(), coarse.end(),
                   [](const CoarsePrimitive& a, const CoarsePrimitive& b) { return a.share > b.share; });
  return coarse;
}

std::optional<std::string> coarseWarning(const std::filesystem::path& path, const CompiledScene& scene) {
  const std::vector<CoarsePrimitive> coarse = findCoarsePrimitives(scene);
  if (coarse.empty()) return std::nullopt;
  const CoarsePrimitive& worst = coarse.front();
  const PrimitiveRange& range = scene.primitives[worst.primitive];
  const std::string rest = coarse.size() == 1 ? ""
                           : coarse.size() == 2
                               ? " (one more primitive has such triangles)"
                               : fmt::format(" ({} more primitives have such triangles)", coarse.size() - 1);
  return fmt::format(
      "{}: node \"{}\", primitive {}: a triangle of {:.3g} m has {:.2g} % of the scene's surface, and values "
      "are baked at its vertices alone: shadows within it are lost{}; RefineRequest::error 0.01 cuts "
      "triangles "
      "where light changes",
      path.string(), range.name, range.primitive, worst.edge, 100.0 * worst.share, rest);
}

}  // namespace prelight
