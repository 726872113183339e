#include "charts/layout_places.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "charts/chart_texels.h"

namespace prelight {

namespace {

/// Returns [face] the lowest face of its chart.
std::vector<std::uint32_t> chartRoots(const LightMapLayout& layout) {
  std::vector<std::uint32_t> parent(layout.chartOf.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;  // position of a corner, face
  for (std::uint32_t face = 0; face < layout.chartOf.size(); ++face) {
    if (layout.chartOf[face] == LightMapLayout::noChart) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec2 place = layout.corners[3 * std::size_t{face} + corner] + 0.0f;
      std::uint64_t key = 0;
      std::memcpy(&key, &place, sizeof key);
      places.emplace_back(key, face);
    }
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].first != places[i - 1].first) continue;
    const std::uint32_t a = root(places[i - 1].second), b = root(places[i].second);
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t face = 0; face < parent.size(); ++face) parent[face] = root(face);
  return parent;
}

void addTexels(const CompiledScene& scene, const std::vector<std::uint32_t>& faces, LightMapLayout& layout) {
  glm::vec2 low(1e30f), high(-1e30f);
  std::vector<glm::vec2> corners;
  for (const std::uint32_t face : faces)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      corners.push_back(layout.corners[3 * std::size_t{face} + corner]);
      low = glm::min(low, corners.back());
      high = glm::max(high, corners.back());
    }
  const glm::ivec2 origin = glm::max(glm::ivec2(glm::floor(low - 0.5f)), glm::ivec2(0)),
                   end =
                       glm::min(glm::ivec2(glm::ceil(high + 0.5f)), glm::ivec2(layout.width, layout.height));
  for (glm::vec2& corner : corners) corner -= glm::vec2(origin);
  const ChartTexels found =
      findChartTexels(std::move(corners), std::max(1, end.x - origin.x), std::max(1, end.y - origin.y));
  for (const ChartTexels::Place& place : found.places)
    layout.texels.push_back(texelOnMap(scene, place, faces[place.triangle], origin, layout.width));
}

}  // namespace

void findChartsAndTexels(const CompiledScene& scene, LightMapLayout& layout) {
  const std::vector<std::uint32_t> roots = chartRoots(layout);
  std::vector<std::vector<std::uint32_t>> facesOf;
  for (std::uint32_t face = 0; face < roots.size(); ++face) {
    if (layout.chartOf[face] == LightMapLayout::noChart) continue;
    if (roots[face] == face) {
      layout.chartOf[face] = static_cast<std::uint32_t>(facesOf.size());
      facesOf.emplace_back();
    }
    layout.chartOf[face] = layout.chartOf[roots[face]];
    facesOf[layout.chartOf[face]].push_back(face);
  }
  layout.chartCount = static_cast<std::uint32_t>(facesOf.size());
  layout.texels.clear();
  for (const std::vector<std::uint32_t>& faces : facesOf) addTexels(scene, faces, layout);
  std::stable_sort(layout.texels.begin(), layout.texels.end(),
                   [](const LightMapTexel& a, const LightMapTexel& b) { return a.texel < b.texel; });
  layout.texels.erase(
      std::unique(layout.texels.begin(), layout.texels.end(),
                  [](const LightMapTexel& a, const LightMapTexel& b) { return a.texel == b.texel; }),
      layout.texels.end());
}

}  // namespace prelight
