#include "charts/back_charts.h"

#include <algorithm>

#include "charts/make_light_map_layout.h"

namespace prelight {

namespace {

/// Returns the charts of requested backs that have none.
LightMapCharts backsOf(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, const LightMapLayout& layout) {
  LightMapCharts backs;
  backs.texelSize = charts.texelSize;
  for (const LightMapChart& chart : charts.charts) {
    if (chart.back || layout.chartOf[scene.triangleCount() + chart.triangles[0]] != LightMapLayout::noChart)
      continue;
    if (std::none_of(chart.triangles.begin(), chart.triangles.end(),
                     [&](std::uint32_t t) { return met[t] != 0; }))
      continue;
    backs.charts.push_back(chart);
    backs.charts.back().back = true;
  }
  return backs;
}

/// Converts the texels' numbers to the map's new width.
void widen(LightMapLayout& layout, int width) {
  const auto before = static_cast<std::uint32_t>(layout.width), now = static_cast<std::uint32_t>(width);
  for (LightMapTexel& t : layout.texels) t.texel = t.texel / before * now + t.texel % before;
  layout.width = width;
}

}  // namespace

std::uint32_t addBacks(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, LightMapLayout& layout) {
  if (met.empty()) return 0;
  const LightMapCharts backs = backsOf(scene, charts, met, layout);
  if (backs.charts.empty()) return 0;
  LightMapLayout below = layOutLightMap(scene, backs);
  const int width = std::max(layout.width, below.width);
  widen(layout, width);
  widen(below, width);
  const auto rows = static_cast<std::uint32_t>(layout.height);
  for (LightMapTexel texel : below.texels) {
    texel.texel += rows * static_cast<std::uint32_t>(width);
    layout.texels.push_back(texel);
  }
  for (std::size_t face = 0; face < below.chartOf.size(); ++face) {
    if (below.chartOf[face] == LightMapLayout::noChart) continue;
    layout.chartOf[face] = layout.chartCount + below.chartOf[face];
    for (std::size_t corner = 0; corner < 3; ++corner)
      layout.corners[3 * face + corner] =
          below.corners[3 * face + corner] + glm::vec2(0.0f, static_cast<float>(rows));
  }
  layout.chartCount += below.chartCount;
  layout.height += below.height;
  return below.chartCount;
}

}  // namespace prelight
