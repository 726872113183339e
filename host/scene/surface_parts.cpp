#include "scene/surface_parts.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <unordered_map>

#include "scene/union_find.h"

namespace prelight {
namespace {

struct PlaceHash {
  std::size_t operator()(const glm::vec3& place) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(place[axis] + 0.0f)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

struct EdgeOfPart {
  std::uint32_t low = 0, high = 0;  ///< positions of its ends, as placesOf() numbers them
  std::uint32_t triangle = 0;
  bool falling = false;  ///< runs from high to low

  bool sameEdge(const EdgeOfPart& other) const { return low == other.low && high == other.high; }
};

/// Returns [vertex of the primitive] the first vertex at its position.
std::vector<std::uint32_t> placesOf(const CompiledScene& scene, const PrimitiveRange& range) {
  std::unordered_map<glm::vec3, std::uint32_t, PlaceHash> first(range.vertexCount);
  std::vector<std::uint32_t> places;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v)
    places.push_back(first.try_emplace(scene.positions[range.firstVertex + v], v).first->second);
  return places;
}

glm::uvec3 cornersOf(const CompiledScene& scene, const PrimitiveRange& range, std::uint32_t triangle) {
  return scene.triangles[range.firstTriangle + triangle] - glm::uvec3(range.firstVertex);
}

std::vector<EdgeOfPart> edgesOf(const CompiledScene& scene, const PrimitiveRange& range) {
  const std::vector<std::uint32_t> places = placesOf(scene, range);
  std::vector<EdgeOfPart> edges;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::uvec3 corners = cornersOf(scene, range, t);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = places[corners[k]], to = places[corners[(k + 1) % 3]];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), t, from > to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeOfPart& a, const EdgeOfPart& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return edges;
}

void joinByVertices(const CompiledScene& scene, const PrimitiveRange& range,
                    std::vector<std::uint32_t>& parents) {
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> first(range.vertexCount, none);
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::uvec3 corners = cornersOf(scene, range, t);
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& user = first[corners[k]];
      if (user == none) user = t;
      parents[rootOf(parents, t)] = rootOf(parents, user);
    }
  }
}

void joinByEdges(const std::vector<EdgeOfPart>& edges, std::vector<std::uint32_t>& parents) {
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    for (end = first + 1; end < edges.size() && edges[end].sameEdge(edges[first]);) ++end;
    if (end == first + 2 && edges[first].falling != edges[first + 1].falling)
      parents[rootOf(parents, edges[first].triangle)] = rootOf(parents, edges[first + 1].triangle);
  }
}

}  // namespace

SurfaceParts surfaceParts(const CompiledScene& scene, const PrimitiveRange& range) {
  std::vector<std::uint32_t> parents(range.triangleCount);
  std::iota(parents.begin(), parents.end(), 0u);
  joinByVertices(scene, range, parents);
  joinByEdges(edgesOf(scene, range), parents);
  SurfaceParts parts;
  std::vector<std::uint32_t> numbers(range.triangleCount, ~0u), sizes;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    std::uint32_t& number = numbers[rootOf(parents, t)];
    if (number == ~0u) {
      number = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    }
    ++sizes[number];
    parts.partOf.push_back(number);
  }
  parts.first.push_back(0);
  for (const std::uint32_t size : sizes) parts.first.push_back(parts.first.back() + size);
  std::vector<std::uint32_t> next(parts.first.begin(), parts.first.end() - 1);
  parts.triangles.resize(range.triangleCount);
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) parts.triangles[next[parts.partOf[t]]++] = t;
  return parts;
}

}  // namespace prelight
