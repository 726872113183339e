#include "charts/make_light_map_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "charts/chart_packing.h"
#include "prelight/error.h"

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
