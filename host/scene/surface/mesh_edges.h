#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns [vertex] the lowest vertex at exactly the same position.
std::vector<std::uint32_t> placesOfVertices(const CompiledScene& scene);

/// A triangle's side, from corner `corner` to the next one.
struct EdgeSide {
  std::uint32_t low = 0;   ///< the lower of its ends' vertices, as placesOfVertices() numbers them
  std::uint32_t high = 0;  ///< the higher of these
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;    ///< 0 to 2
  std::uint8_t reversed = 0;  ///< 1: the triangle runs from `high` to `low`

  bool sameEdge(const EdgeSide& other) const { return low == other.low && high == other.high; }
};

/// Returns the sides of all triangles, sorted by edge and then by triangle. Sides whose ends are at the same
/// position are left out.
std::vector<EdgeSide> edgeSidesOf(const CompiledScene& scene, std::span<const std::uint32_t> places);

/// Calls visit(sides) with the sides of each edge.
template <typename Visitor>
void forEachEdge(std::span<const EdgeSide> sides, const Visitor& visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    for (end = first + 1; end < sides.size() && sides[end].sameEdge(sides[first]);) ++end;
    visit(sides.subspan(first, end - first));
  }
}

/// Calls visit(a, b) for every two sides of different triangles that share an edge and run along it in
/// opposite directions. Edges with more than 32 sides are left out: they belong to no surface, and the number
/// of pairs grows with the square.
template <typename Visitor>
void forEachContinuation(const CompiledScene& scene, const Visitor& visit) {
  constexpr std::size_t mostSides = 32;
  const std::vector<EdgeSide> sides = edgeSidesOf(scene, placesOfVertices(scene));
  forEachEdge(std::span(sides), [&](std::span<const EdgeSide> edge) {
    if (edge.size() > mostSides) return;
    for (std::size_t i = 0; i < edge.size(); ++i)
      for (std::size_t k = i + 1; k < edge.size(); ++k)
        if (edge[i].reversed != edge[k].reversed && edge[i].triangle != edge[k].triangle)
          visit(edge[i], edge[k]);
  });
}

/// Returns the root of a member's set and shortens the path to it. parents: for each member another one of
/// its set, or itself for roots.
inline std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t member) {
  while (parents[member] != member) member = parents[member] = parents[parents[member]];
  return member;
}

}  // namespace prelight
