#include "scene/closed_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "scene/union_find.h"

namespace prelight {
namespace {

/// Greatest distances of positions that are merged, relative to the primitive's size and to the largest
/// coordinate: rounding.
constexpr double weldOfSize = 2e-6, weldOfPlace = 3e-7;

struct CellHash {
  std::size_t operator()(const glm::i64vec3& cell) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (int k = 0; k < 3; ++k) {
      hash = (hash ^ static_cast<std::uint64_t>(cell[k])) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Returns for each vertex of a primitive the first vertex at its position.
std::vector<std::uint32_t> weldedVertices(const CompiledScene& scene, const PrimitiveRange& range) {
  glm::dvec3 lower(1e300), upper(-1e300);
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::dvec3 p(scene.positions[range.firstVertex + v]);
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const double farthest = glm::length(glm::max(glm::abs(lower), glm::abs(upper)));
  const double side = std::max({weldOfSize * glm::length(upper - lower), weldOfPlace * farthest, 1e-30});
  std::unordered_map<glm::i64vec3, std::uint32_t, CellHash> cells;
  std::vector<std::uint32_t> welded(range.vertexCount);
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::i64vec3 cell(glm::floor(glm::dvec3(scene.positions[range.firstVertex + v]) / side));
    welded[v] = v;
    for (int n = 0; n < 27 && welded[v] == v; ++n)
      if (const auto near = cells.find(cell + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
          near != cells.end())
        welded[v] = near->second;
    if (welded[v] == v) cells.emplace(cell, v);
  }
  return welded;
}

struct DirectedEdge {
  std::uint32_t low, high;
  bool falling;  ///< runs from high to low
  std::uint32_t triangle;

  auto key() const { return std::tuple(low, high, falling); }
};

std::vector<DirectedEdge> edgesOf(const CompiledScene& scene, const PrimitiveRange& range) {
  const std::vector<std::uint32_t> welded = weldedVertices(scene, range);
  std::vector<DirectedEdge> edges;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    std::array<std::uint32_t, 3> corners{};
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] =
          welded[scene.triangles[range.firstTriangle + t][k] - range.firstVertex];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), from > to, t});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const DirectedEdge& a, const DirectedEdge& b) { return a.key() < b.key(); });
  return edges;
}

}  // namespace

std::optional<std::vector<ClosedPart>> closedParts(const CompiledScene& scene, const PrimitiveRange& range) {
  const std::vector<DirectedEdge> edges = edgesOf(scene, range);
  if (edges.empty() || edges.size() % 2 != 0) return std::nullopt;
  std::vector<std::uint32_t> parents(range.triangleCount);
  std::iota(parents.begin(), parents.end(), 0u);
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    const DirectedEdge &a = edges[e], &b = edges[e + 1];
    const bool pair = a.low == b.low && a.high == b.high && !a.falling && b.falling;
    const bool more = e > 0 && edges[e - 1].low == a.low && edges[e - 1].high == a.high;
    if (!pair || more) return std::nullopt;
    parents[rootOf(parents, a.triangle)] = rootOf(parents, b.triangle);
  }
  std::map<std::uint32_t, ClosedPart> found;
  const glm::dvec3 centre(scene.positions[scene.triangles[range.firstTriangle].x]);
  for (const DirectedEdge& edge : edges) {
    ClosedPart& part = found[rootOf(parents, edge.triangle)];
    const std::uint32_t t = range.firstTriangle + edge.triangle;
    // Each triangle is visited three times, once per edge.
    const glm::dvec3 face = geometricNormal(scene, t) / 6.0;
    part.area += glm::length(face);
    part.volume += glm::dot(glm::dvec3(scene.positions[scene.triangles[t].x]) - centre, face) / 3.0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p(scene.positions[scene.triangles[t][k]]);
      part.lower = glm::min(part.lower, p);
      part.upper = glm::max(part.upper, p);
    }
  }
  std::vector<ClosedPart> parts;
  for (const auto& [root, part] : found) parts.push_back(part);
  return parts;
}

}  // namespace prelight
