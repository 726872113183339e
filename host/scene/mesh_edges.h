#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// [vertex], the lowest vertex at the very same place.
std::vector<std::uint32_t> placesOfVertices(const CompiledScene& scene);

/// A side of a triangle, from corner `corner` to the next one.
struct EdgeSide {
  std::uint32_t low = 0;   ///< the lower of the places of its ends
  std::uint32_t high = 0;  ///< the higher one
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;    ///< 0 to 2
  std::uint8_t reversed = 0;  ///< 1: the triangle goes from `high` to `low`

  bool sameEdge(const EdgeSide& other) const { return low == other.low && high == other.high; }
};

/// Sides of all triangles, those of the same edge one after the other, then by triangle. Sides whose ends are
/// at the same place are left out.
std::vector<EdgeSide> edgeSidesOf(const CompiledScene& scene, std::span<const std::uint32_t> places);

/// Calls visit(first, end) for the sides of each edge.
template <typename Visitor>
void forEachEdge(std::span<const EdgeSide> sides, const Visitor& visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    for (end = first + 1; end < sides.size() && sides[end].sameEdge(sides[first]);) ++end;
    visit(sides.subspan(first, end - first));
  }
}

/// Calls visit(a, b) for every two sides of different triangles that continue one another: they share an edge
/// and go along it in opposite ways. Edges of more than 32 triangles are left out: they are no surface, and
/// pairs grow with the square.
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

}  // namespace prelight
