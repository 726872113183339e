#include "scene/closed_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "scene/light_sources.h"
#include "scene/surface/mesh_edges.h"

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

namespace {

/// Least ratio of volume to area^(3/2), which is 0.094 for a ball. The sides of flatter bodies are not
/// decided.
constexpr double leastVolume = 0.004;

bool contain(const ClosedPart& bounds, const glm::dvec3& p) {
  return glm::all(glm::greaterThan(p, bounds.lower)) && glm::all(glm::lessThan(p, bounds.upper));
}

glm::dvec3 centreOf(const ClosedPart& part) { return 0.5 * (part.lower + part.upper); }

bool glowsOnBothSides(const CompiledScene& scene, const PrimitiveRange& range) {
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[range.firstTriangle + t]];
    if (!material.doubleSided || !shines(material.emission)) return false;
  }
  return range.triangleCount > 0;
}

}  // namespace

BodySide sideOfBodies(const CompiledScene& scene, const PrimitiveRange& range) {
  const auto parts = closedParts(scene, range);
  if (!parts || parts->empty() || parts->size() > mostClosedBodies) return BodySide::Unclear;
  const double sign = parts->front().volume < 0.0 ? -1.0 : 1.0;
  for (const ClosedPart& part : *parts) {
    if (!(sign * part.volume > leastVolume * std::pow(part.area, 1.5))) return BodySide::Unclear;
    for (const ClosedPart& other : *parts)
      if (&other != &part && contain(part, centreOf(other))) return BodySide::Unclear;
  }
  return sign < 0.0 ? BodySide::Inside : BodySide::Outside;
}

ClosedPart asClosed(const CompiledScene& scene, const PrimitiveRange& range) {
  ClosedPart whole;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::dvec3 p(scene.positions[range.firstVertex + v]);
    whole.lower = glm::min(whole.lower, p);
    whole.upper = glm::max(whole.upper, p);
  }
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::dvec3 face = 0.5 * geometricNormal(scene, range.firstTriangle + t);
    const glm::dvec3 corner(scene.positions[scene.triangles[range.firstTriangle + t].x]);
    whole.area += glm::length(face);
    whole.volume += glm::dot(corner - centreOf(whole), face) / 3.0;
  }
  return whole;
}

BodyCentres::BodyCentres(std::span<const ClosedPart> bodies) {
  for (std::uint32_t i = 0; i < bodies.size(); ++i) centres_.emplace_back(centreOf(bodies[i]), i);
  std::sort(centres_.begin(), centres_.end(),
            [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
}

bool BodyCentres::anyWithin(const ClosedPart& bounds, std::uint32_t butNot) const {
  auto centre = std::upper_bound(centres_.begin(), centres_.end(), bounds.lower.x,
                                 [](double x, const auto& other) { return x < other.first.x; });
  for (; centre != centres_.end() && centre->first.x < bounds.upper.x; ++centre)
    if (centre->second != butNot && contain(bounds, centre->first)) return true;
  return false;
}

std::vector<BodySide> glowingBodies(const CompiledScene& scene) {
  std::vector<BodySide> sides(scene.primitives.size(), BodySide::Unclear);
  std::vector<std::uint32_t> glowing;
  for (std::uint32_t i = 0; i < scene.primitives.size(); ++i)
    if (glowsOnBothSides(scene, scene.primitives[i])) glowing.push_back(i);
  if (glowing.empty() || glowing.size() > mostClosedBodies) return sides;
  std::vector<ClosedPart> wholes;
  for (const PrimitiveRange& range : scene.primitives) wholes.push_back(asClosed(scene, range));
  const BodyCentres centres(wholes);
  for (const std::uint32_t i : glowing)
    if (!centres.anyWithin(wholes[i], i)) sides[i] = sideOfBodies(scene, scene.primitives[i]);
  return sides;
}

namespace {

/// Greatest number of pairs of parts whose bounds are compared; with more, the rest are taken to meet.
constexpr std::size_t mostPairs = 4'000'000;

constexpr float sizeOfPlace = 1e-6f;  ///< size of a cell as a share of the scene's

/// Triangles that are connected by shared positions.
struct Part {
  glm::vec3 lower{3e38f}, upper{-3e38f};
  std::uint64_t openEdges = 0;  ///< sum of codes of directed edges: 0 when each edge has an opposite one
  double volume = 0.0;
  bool opaque = true;  ///< opaque and one-sided

  bool isSolid() const { return opaque && openEdges == 0 && volume > 0.0; }
};

std::uint64_t scrambled(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

struct GridHash {
  std::size_t operator()(const glm::ivec3& cell) const {
    const auto part = [](int x) { return std::uint64_t{static_cast<std::uint32_t>(x)}; };
    return static_cast<std::size_t>(
        scrambled(part(cell.x) + (part(cell.y) << 32) + 0x9e3779b97f4a7c15u * part(cell.z)));
  }
};

/// Returns [vertex] a vertex that represents all at its position: those in one cell of either of two grids
/// offset by half a cell, so that rounding separates few equal positions.
std::vector<std::uint32_t> placesOf(const CompiledScene& scene) {
  const float side = std::max(sizeOfPlace * glm::length(scene.boundsMax - scene.boundsMin), 1e-30f);
  std::vector<std::uint32_t> places(scene.vertexCount());
  std::iota(places.begin(), places.end(), 0u);
  for (const float shift : {0.0f, 0.5f}) {
    std::unordered_map<glm::ivec3, std::uint32_t, GridHash> first(scene.vertexCount());
    for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
      const glm::vec3 place = (scene.positions[v] - scene.boundsMin) / side;
      const auto cell = first.emplace(glm::ivec3(glm::floor(place + shift)), v).first;
      places[rootOf(places, v)] = rootOf(places, cell->second);
    }
  }
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) places[v] = rootOf(places, v);
  return places;
}

/// Returns a code such that opposite edges cancel in a sum; collisions of others are negligibly rare.
std::uint64_t codeOf(std::uint32_t from, std::uint32_t to) {
  if (from == to) return 0;
  const std::uint64_t code = scrambled((std::uint64_t{std::min(from, to)} << 32 | std::max(from, to)) + 1);
  return from < to ? code : 0 - code;
}

bool hidesInside(const CompiledMaterial& material) {
  return !material.doubleSided && !material.blended && material.alphaCutoff < 0.0f &&
         material.transmission == 0.0f && material.translucency == 0.0f;
}

struct Parts {
  std::vector<Part> parts;
  std::vector<std::uint32_t> partOf;  ///< [triangle]
};

Parts partsOf(const CompiledScene& scene) {
  const std::vector<std::uint32_t> places = placesOf(scene);
  std::vector<std::uint32_t> parents(places.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (const glm::uvec3& t : scene.triangles)
    for (const std::uint32_t v : {t.y, t.z})
      parents[rootOf(parents, places[t.x])] = rootOf(parents, places[v]);
  Parts found;
  std::vector<std::uint32_t> numbers(places.size(), ~0u);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::uvec3& corners = scene.triangles[t];
    std::uint32_t& number = numbers[rootOf(parents, places[corners.x])];
    if (number == ~0u) {
      number = static_cast<std::uint32_t>(found.parts.size());
      found.parts.emplace_back();
    }
    found.partOf.push_back(number);
    Part& part = found.parts[number];
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& p = scene.positions[corners[k]];
      part.lower = glm::min(part.lower, p);
      part.upper = glm::max(part.upper, p);
      part.openEdges += codeOf(places[corners[k]], places[corners[(k + 1) % 3]]);
    }
    part.opaque = part.opaque && hidesInside(scene.materials[scene.triangleMaterials[t]]);
    part.volume += glm::dot(glm::dvec3(scene.positions[corners.x]), geometricNormal(scene, t));
  }
  return found;
}

bool overlap(const Part& a, const Part& b) {
  return glm::all(glm::lessThan(a.lower, b.upper)) && glm::all(glm::lessThan(b.lower, a.upper));
}

/// Returns [part] whether it is a solid and the bounds of another part reach into its bounds.
std::vector<std::uint8_t> enteredSolids(const std::vector<Part>& parts) {
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return parts[a].lower.x < parts[b].lower.x; });
  std::vector<std::uint8_t> entered(parts.size(), 0);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Part &a = parts[order[i]], &b = parts[order[j]];
      if (!(b.lower.x < a.upper.x)) break;
      if (++pairs < mostPairs && !overlap(a, b)) continue;
      if (a.isSolid()) entered[order[i]] = 1;
      if (b.isSolid()) entered[order[j]] = 1;
      if (pairs >= mostPairs) break;
    }
  return entered;
}

}  // namespace

std::vector<std::uint8_t> trianglesOfEnteredSolids(const CompiledScene& scene) {
  const Parts found = partsOf(scene);
  const std::vector<std::uint8_t> entered = enteredSolids(found.parts);
  if (std::none_of(entered.begin(), entered.end(), [](std::uint8_t mark) { return mark != 0; })) return {};
  std::vector<std::uint8_t> triangles(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) triangles[t] = entered[found.partOf[t]];
  return triangles;
}

}  // namespace prelight
