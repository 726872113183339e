#include "charts/make_light_map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "charts/chart_texels.h"
#include "prelight/error.h"

namespace prelight {

namespace {

std::vector<ChartTexels> texelsOf(const LightMapCharts& charts, std::span<const double> texelSizes) {
  std::vector<ChartTexels> texels(charts.charts.size());
  parallelRanges(texels.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      texels[c] = makeChartTexels(charts.charts[c], texelSizes.empty() ? charts.texelSize : texelSizes[c]);
  });
  return texels;
}

/// Checks the texels per side of the largest chart and the number of all texels, before any are made.
void checkSize(const LightMapCharts& charts, std::span<const double> texelSizes) {
  constexpr double most = mostLightMapSide;
  double texels = 0.0, longest = 0.0;
  for (std::size_t c = 0; c < charts.charts.size(); ++c) {
    const glm::dvec2 size = charts.charts[c].size / (texelSizes.empty() ? charts.texelSize : texelSizes[c]);
    longest = std::max(longest, size.x);
    texels += size.x * size.y;
  }
  // With more texels packing is not tried: shapes that fill less of their rectangles are rare.
  if (longest + 1.0 <= most && texels <= 3.0 * most * most) return;
  refuseTexelSize(charts.texelSize,
                  charts.texelSize * std::max(longest / most, std::sqrt(texels) / most) * 1.2);
}

LightMapLayout placed(const CompiledScene& scene, const LightMapCharts& charts,
                      const std::vector<ChartTexels>& texels, const MaskPacking& packing) {
  LightMapLayout layout;
  layout.width = packing.width;
  layout.height = packing.height;
  layout.chartCount = static_cast<std::uint32_t>(charts.charts.size());
  const std::size_t faces = 2 * std::size_t{scene.triangleCount()};
  layout.corners.assign(3 * faces, glm::vec2(0.0f));
  layout.chartOf.assign(faces, LightMapLayout::noChart);
  for (std::size_t c = 0; c < texels.size(); ++c) {
    const LightMapChart& chart = charts.charts[c];
    const glm::ivec2 origin = packing.origins[c];
    const std::uint32_t firstFace = chart.back ? scene.triangleCount() : 0;
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const std::size_t face = firstFace + chart.triangles[t];
      layout.chartOf[face] = static_cast<std::uint32_t>(c);
      for (std::size_t corner = 0; corner < 3; ++corner)
        layout.corners[3 * face + corner] = glm::vec2(origin) + texels[c].corners[3 * t + corner];
    }
    for (const ChartTexels::Place& place : texels[c].places)
      layout.texels.push_back(
          texelOnMap(scene, place, firstFace + chart.triangles[place.triangle], origin, layout.width));
  }
  std::sort(layout.texels.begin(), layout.texels.end(),
            [](const LightMapTexel& a, const LightMapTexel& b) { return a.texel < b.texel; });
  return layout;
}

}  // namespace

void refuseTexelSize(double size, double least) {
  throw UsageError("LightMapRequest::texelSize",
                   fmt::format("texels of {:.3g} m make a light map of more than {} x {}", size,
                               mostLightMapSide, mostLightMapSide),
                   fmt::format("ask for {:.2g} m or more", least));
}

LightMapLayout layOutLightMap(const CompiledScene& scene, const LightMapCharts& charts,
                              std::span<const double> texelSizes) {
  checkSize(charts, texelSizes);
  const std::vector<ChartTexels> texels = texelsOf(charts, texelSizes);
  std::vector<ChartMask> masks;
  masks.reserve(texels.size());
  for (const ChartTexels& chart : texels) masks.push_back(chart.mask);
  const std::optional<MaskPacking> packing = packMasks(masks, mostLightMapSide);
  if (!packing)
    throw UsageError("LightMapRequest::texelSize",
                     fmt::format("texels of {:.3g} m make a light map of more than {} x {}", charts.texelSize,
                                 mostLightMapSide, mostLightMapSide),
                     fmt::format("ask for {:.2g} m or more", 1.3 * charts.texelSize));
  return placed(scene, charts, texels, *packing);
}

LightMapLayout makeLightMapLayout(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request) {
  return layOutLightMap(compiled, makeLightMapCharts(scene, compiled, request));
}

}  // namespace prelight
