#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "viewer/debug/debug_colors.h"
#include "viewer/debug/debug_rows.h"
#include "viewer/debug/map_layout.h"
#include "viewer/debug/surface_colors.h"

namespace prelight::viewer {

const LightMapLayout* mapLayoutOf(const RenderInputs& inputs) {
  if (inputs.globalIllumination != nullptr) return &inputs.globalIllumination->indirect.layout;
  if (inputs.bake != nullptr && inputs.bake->lightMap) return &inputs.bake->lightMap->layout;
  return nullptr;
}

namespace {

constexpr glm::vec3 noTexels(0.03f);

DebugLack lackOfMap(const RenderInputs& inputs) {
  if (mapLayoutOf(inputs) != nullptr) return {};
  return {"there is no light map", "add --shading lightmap or --shading full"};
}

DebugLack lackOfLiveMap(const RenderInputs& inputs) {
  if (inputs.live != nullptr && !inputs.live->approximation().empty()) return {};
  return {"no indirect light follows the scene", "add --shading full, for a scene in which something shines"};
}

/// Returns the smallest and the greatest of the values above 0; (0, 0) if there are none.
std::pair<double, double> rangeOf(const std::vector<double>& values) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0.0};
  for (const double value : values)
    if (value > 0.0 && std::isfinite(value))
      range = {std::min(range.first, value), std::max(range.second, value)};
  return range.second > 0.0 ? range : std::pair(0.0, 0.0);
}

/// Returns the place of a value within a range on a logarithmic scale, 0 to 1.
double logShare(double value, const std::pair<double, double>& range) {
  if (!(range.second > 1.0001 * range.first)) return 0.5;
  return std::log(value / range.first) / std::log(range.second / range.first);
}

/// Returns [face], texels of a map per metre of the surface; 0 where the face has no place in the map, or a
/// single point of it.
std::vector<double> texelsPerMetre(const CompiledScene& scene, const LightMapLayout& layout) {
  std::vector<double> densities(2 * std::size_t{scene.triangleCount()}, 0.0);
  for (std::size_t face = 0; face < std::min(densities.size(), layout.chartOf.size()); ++face) {
    if (layout.chartOf[face] == LightMapLayout::noChart) continue;
    const glm::dvec2 a(layout.corners[3 * face]), ab = glm::dvec2(layout.corners[3 * face + 1]) - a,
                                                  ac = glm::dvec2(layout.corners[3 * face + 2]) - a;
    const auto triangle = static_cast<std::uint32_t>(face % scene.triangleCount());
    densities[face] =
        std::sqrt(std::abs(ab.x * ac.y - ab.y * ac.x) / glm::length(geometricNormal(scene, triangle)));
  }
  return densities;
}

std::unique_ptr<DebugDrawing> drawTexelDensity(const DebugInputs& of) {
  const LightMapLayout& layout = *mapLayoutOf(of.inputs);
  const std::vector<double> densities = texelsPerMetre(of.inputs.compiled, layout);
  const auto range = rangeOf(densities);
  SurfaceColors colors{Coloring::Faces};
  for (std::size_t face = 0; face < densities.size(); ++face) {
    const bool isPoint = face < layout.chartOf.size() && layout.chartOf[face] != LightMapLayout::noChart;
    colors.colors.push_back(densities[face] > 0.0 ? scaleColor(logShare(densities[face], range))
                            : isPoint             ? glm::vec3(0.4f, 0.05f, 0.5f)
                                                  : noTexels);
  }
  colors.legend = fmt::format("blue {:.3g}, red {:.3g} texels per metre; violet: one texel for a whole chart",
                              range.first, range.second);
  return drawSurfaceColors(colors, of);
}

std::vector<std::uint32_t> texelsOfCharts(const LightMapLayout& layout) {
  std::vector<std::uint32_t> counts(layout.chartCount, 0);
  for (const LightMapTexel& texel : layout.texels)
    if (const std::uint32_t chart = layout.chartOf[texel.face]; chart < counts.size()) ++counts[chart];
  return counts;
}

std::unique_ptr<DebugDrawing> drawCharts(const DebugInputs& of) {
  const LightMapLayout& layout = *mapLayoutOf(of.inputs);
  SurfaceColors colors{Coloring::Faces};
  colors.colors.assign(2 * std::size_t{of.inputs.compiled.triangleCount()}, noTexels);
  for (std::size_t face = 0; face < std::min(colors.colors.size(), layout.chartOf.size()); ++face)
    if (layout.chartOf[face] != LightMapLayout::noChart)
      colors.colors[face] = distinctColor(layout.chartOf[face]);
  const std::vector<std::uint32_t> counts = texelsOfCharts(layout);
  if (!counts.empty())
    colors.legend =
        fmt::format("{} charts of {} to {} texels, in a map of {} x {}", layout.chartCount,
                    std::ranges::min(counts), std::ranges::max(counts), layout.width, layout.height);
  return drawSurfaceColors(colors, of);
}

/// Returns colours of a map's texels, which `colorOf` gives for the layout's texels by their index.
template <typename ColorOf>
SurfaceColors texelColors(const LightMapLayout& layout, const ColorOf& colorOf) {
  SurfaceColors colors{Coloring::Texels};
  colors.layout = &layout;
  colors.colors.assign(layout.texelCount(), noTexels);
  for (std::size_t i = 0; i < layout.texels.size(); ++i) colors.colors[layout.texels[i].texel] = colorOf(i);
  return colors;
}

std::unique_ptr<DebugDrawing> drawTexels(const DebugInputs& of) {
  const LightMapLayout& layout = *mapLayoutOf(of.inputs);
  const auto width = static_cast<std::uint32_t>(layout.width);
  SurfaceColors colors = texelColors(layout, [&](std::size_t i) {
    const LightMapTexel& texel = layout.texels[i];
    const bool dark = (texel.texel % width + texel.texel / width) % 2 != 0;
    return (dark ? 0.35f : 1.0f) * distinctColor(layout.chartOf[texel.face]);
  });
  colors.legend = fmt::format("{} texels of {} charts", layout.texels.size(), layout.chartCount);
  return drawSurfaceColors(colors, of);
}

std::unique_ptr<DebugDrawing> drawApproximation(const DebugInputs& of) {
  const std::span<const glm::vec3> irradiance = of.inputs.live->approximation();
  std::vector<float> sorted;
  for (const glm::vec3& value : irradiance) sorted.push_back(std::max({value.x, value.y, value.z}));
  const auto nearWhite = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 98 / 100);
  std::ranges::nth_element(sorted, nearWhite);
  const float white = std::max(*nearWhite, 1e-20f);
  SurfaceColors colors =
      texelColors(of.inputs.live->layout(), [&](std::size_t i) { return 0.75f / white * irradiance[i]; });
  colors.legend = fmt::format("0.75 stands for {:.3g} W/m2", white);
  return drawSurfaceColors(colors, of);
}

std::unique_ptr<DebugDrawing> drawPriority(const DebugInputs& of) {
  const std::vector<double> changes = of.inputs.live->expectedChanges();
  const auto range = rangeOf(changes);
  SurfaceColors colors = texelColors(of.inputs.live->layout(), [&](std::size_t i) {
    if (std::isinf(changes[i])) return glm::vec3(0.75f);
    return changes[i] > 0.0 ? scaleColor(logShare(changes[i], range)) : noTexels;
  });
  const auto waiting = std::ranges::count_if(changes, [](double change) { return change > 0.0; });
  colors.legend =
      fmt::format("{} of {} texels wait; blue {:.3g}, red {:.3g} W/m2; white: on objects that have moved",
                  waiting, changes.size(), range.first, range.second);
  return drawSurfaceColors(colors, of);
}

constexpr std::array<DebugRow, 5> mapTable = {{
    {DebugView::TexelDensity, lackOfMap, drawTexelDensity},
    {DebugView::Charts, lackOfMap, drawCharts},
    {DebugView::Texels, lackOfMap, drawTexels},
    {DebugView::Approximation, lackOfLiveMap, drawApproximation},
    {DebugView::Priority, lackOfLiveMap, drawPriority},
}};

}  // namespace

std::span<const DebugRow> mapRows() { return mapTable; }

}  // namespace prelight::viewer
