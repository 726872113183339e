#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/surface/surface_regions.h"

namespace prelight {

/// Adjacent triangles within groups, in compressed rows.
struct TriangleNeighbours {
  std::vector<std::uint32_t> rowStart;  ///< [triangle], then the end
  std::vector<std::uint32_t> columns;   ///< neighbours, ascending

  std::span<const std::uint32_t> of(std::uint32_t triangle) const {
    return {&columns[rowStart[triangle]], &columns[rowStart[triangle + 1]]};
  }
};

/// Returns the pairs of triangles of the same group that share an edge and run along it in opposite
/// directions. `groups`: [triangle], or noGroup. An edge of more than 32 triangles connects none.
TriangleNeighbours neighboursOf(const CompiledScene& scene, std::span<const std::uint32_t> groups);

constexpr std::uint32_t noGroup = 0xffffffffu;

/// Sets of triangles, each of which is flattened by projection onto a plane without much stretch.
struct GrownCharts {
  std::vector<std::uint32_t> chartOf;  ///< [triangle], or noGroup
  std::vector<glm::dvec3> axes;        ///< [chart], unit: the plane's normal
};

/// Least cosine between a triangle of a chart and the chart's plane.
constexpr double leastChartCosine = 0.5;

/// Divides every region of each group into charts: one where the mean normal permits it, otherwise several
/// grown from seeds by the deviation of normals (Cohen-Steiner, Alliez, Desbrun 2004, with a bound). Charts
/// of less than `leastArea` (m2) then join neighbours, also across creases.
GrownCharts growCharts(const CompiledScene& scene, const SurfaceRegions& regions,
                       std::span<const std::uint32_t> groups, const TriangleNeighbours& neighbours,
                       double leastArea);

}  // namespace prelight
