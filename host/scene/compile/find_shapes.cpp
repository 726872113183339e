#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scene/compile/compile_parts.h"

namespace prelight {

namespace {

/// All primitives of a mesh, as one node draws it.
struct Drawing {
  std::size_t meshNode = 0;
  glm::dmat4 toWorld{1.0};
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
};

/// Returns the drawings in the order in which they were flattened.
std::vector<Drawing> listDrawings(const Scene& scene, const DrawnMeshes& meshes,
                                  const CompiledScene& compiled) {
  std::vector<Drawing> drawings;
  auto range = compiled.primitives.begin();
  for (std::size_t n = 0; n < scene.meshNodes.size(); ++n)
    for (std::size_t instance = 0; instance < scene.meshNodes[n].transforms.size(); ++instance) {
      Drawing drawing;
      drawing.meshNode = n;
      drawing.toWorld = meshes.transformOf(n, instance);
      const std::size_t primitives = meshes.meshOf(n).primitives.size();
      for (std::size_t p = 0; p < primitives; ++p, ++range) {
        if (p == 0) drawing.firstTriangle = range->firstTriangle;
        if (p == 0) drawing.firstVertex = range->firstVertex;
        drawing.triangleCount += range->triangleCount;
        drawing.vertexCount += range->vertexCount;
      }
      if (drawing.triangleCount > 0) drawings.push_back(drawing);
    }
  return drawings;
}

/// Bounds within which rays keep enough of their precision in an instance's space: of the scale of the
/// transform and of its inverse, and of the ratio between the scales of its axes.
constexpr double greatestScale = 1e6;
constexpr double greatestStretch = 1e3;

double largestRow(const glm::dmat3& m) {
  const glm::dmat3 rows = glm::transpose(m);
  return std::max({glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2])});
}

bool hasUsableInverse(const glm::dmat4& toWorld) {
  const glm::dmat3 linear(toWorld);
  const double there = largestRow(linear), back = largestRow(glm::inverse(linear));
  return std::isfinite(there) && std::isfinite(back) && there <= greatestScale && back <= greatestScale &&
         there * back <= greatestStretch;
}

bool sameTriangles(const CompiledScene& scene, const Drawing& a, const Drawing& b) {
  if (a.triangleCount != b.triangleCount || a.vertexCount != b.vertexCount) return false;
  for (std::uint32_t t = 0; t < a.triangleCount; ++t)
    if (scene.triangles[a.firstTriangle + t] - a.firstVertex !=
        scene.triangles[b.firstTriangle + t] - b.firstVertex)
      return false;
  return true;
}

/// Returns the positions of a mesh as they are flattened, relative to `centre`, which is computed.
std::vector<glm::vec3> centredPositions(const Mesh& mesh, glm::dvec3& centre) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Primitive& primitive : mesh.primitives)
    for (std::size_t v = 0; !primitive.triangles.empty() && v < primitive.positions.size(); ++v) {
      low = glm::min(low, glm::dvec3(primitive.positions[v]));
      high = glm::max(high, glm::dvec3(primitive.positions[v]));
    }
  centre = 0.5 * low + 0.5 * high;
  std::vector<glm::vec3> positions;
  for (const Primitive& primitive : mesh.primitives)
    for (std::size_t v = 0; !primitive.triangles.empty() && v < primitive.positions.size(); ++v)
      positions.emplace_back(glm::dvec3(primitive.positions[v]) - centre);
  return positions;
}

void addShape(const Mesh& mesh, const Drawing& model, const std::vector<const Drawing*>& drawings,
              CompiledScene& scene) {
  glm::dvec3 centre(0.0);
  const auto shape = static_cast<std::uint32_t>(scene.shapes.size());
  scene.shapes.push_back({model.firstTriangle, model.triangleCount, model.firstVertex, model.vertexCount,
                          centredPositions(mesh, centre)});
  for (const Drawing* drawing : drawings) {
    glm::dmat4 toWorld = drawing->toWorld;
    toWorld[3] = glm::dvec4(glm::dvec3(toWorld * glm::dvec4(centre, 1.0)) - scene.origin, 1.0);
    scene.instances.push_back({shape, drawing->firstTriangle, drawing->firstVertex, toWorld});
  }
}

}  // namespace

void findShapes(const Scene& scene, const DrawnMeshes& meshes, CompiledScene& compiled) {
  // Drawings that mirror need their own triangles, because their winding is reversed.
  std::map<std::pair<int, bool>, std::vector<Drawing>> drawingsOf;
  for (const Drawing& drawing : listDrawings(scene, meshes, compiled))
    if (hasUsableInverse(drawing.toWorld))
      drawingsOf[{meshes.shapeOf(drawing.meshNode), glm::determinant(glm::dmat3(drawing.toWorld)) < 0.0}]
          .push_back(drawing);
  for (const auto& [key, drawings] : drawingsOf) {
    std::vector<const Drawing*> same;
    for (const Drawing& drawing : drawings)
      if (sameTriangles(compiled, drawings[0], drawing)) same.push_back(&drawing);
    if (same.size() > 1) addShape(meshes.meshOf(drawings[0].meshNode), drawings[0], same, compiled);
  }
  std::sort(compiled.instances.begin(), compiled.instances.end(),
            [](const auto& a, const auto& b) { return a.firstTriangle < b.firstTriangle; });
}

}  // namespace prelight
