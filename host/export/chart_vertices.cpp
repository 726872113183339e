#include "export/chart_vertices.h"

#include <map>
#include <numeric>
#include <tuple>

#include "charts/corner_places.h"

namespace prelight {

ChartVertices findChartVertices(const FileTriangles& triangles, const LightMapLayout& layout,
                                std::size_t firstFace, std::size_t vertexCount) {
  constexpr glm::vec2 unknown(-1.0f);
  ChartVertices result;
  result.originals = vertexCount;
  result.source.resize(vertexCount);
  std::iota(result.source.begin(), result.source.end(), 0u);
  result.coords.assign(vertexCount, unknown);
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> further;
  for (std::size_t t = 0; t < triangles.corners.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = triangles.corners[t][static_cast<int>(corner)];
      result.indices.push_back(vertex);
      const std::optional<glm::vec2> place = cornerPlace(layout, triangles, firstFace, t, corner);
      if (!place) continue;
      glm::vec2& known = result.coords[vertex];
      if (known == unknown) known = *place;
      if (known == *place) continue;
      const auto [found, fresh] =
          further.try_emplace({vertex, place->x, place->y}, static_cast<std::uint32_t>(result.source.size()));
      if (fresh) {
        result.source.push_back(vertex);
        result.coords.push_back(*place);
      }
      result.indices.back() = found->second;
    }
  for (glm::vec2& coord : result.coords)
    if (coord == unknown) coord = glm::vec2(0.0f);
  return result;
}

}  // namespace prelight
