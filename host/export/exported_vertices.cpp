#include "export/exported_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "export/map_picture.h"

namespace prelight {

namespace {

/// Ratio of the largest values of neighbouring ranges. The darkest range has no lower end.
constexpr float rangeWidth = 8.0f;
constexpr std::size_t mostRanges = 4;
/// Least share of the map's texels in a range. Smaller ranges join the next brighter one, as each range needs
/// separate primitives.
constexpr double leastShare = 0.05;

std::vector<float> largestOfCharts(const Picture& picture, const LightMapLayout& layout) {
  std::vector<float> largest(layout.chartCount, 0.0f);
  for (const LightMapTexel& texel : layout.texels) {
    const glm::vec3& value = picture.pixels[texel.texel];
    float& known = largest[layout.chartOf[texel.face]];
    known = std::max({known, value.x, value.y, value.z});
  }
  return largest;
}

/// Returns for each range the kept range that it joins. The first range is always kept.
std::array<std::uint8_t, mostRanges> placesOfRanges(const std::array<std::size_t, mostRanges>& texels,
                                                    std::size_t all) {
  std::array<std::uint8_t, mostRanges> place{};
  for (std::size_t range = 1; range < mostRanges; ++range) {
    const bool kept = static_cast<double>(texels[range]) >= leastShare * static_cast<double>(all);
    place[range] = static_cast<std::uint8_t>(place[range - 1] + (kept ? 1 : 0));
  }
  return place;
}

}  // namespace

int ChartRanges::at(const LightMapLayout& layout, std::size_t face) const {
  const std::uint32_t chart = layout.chartOf[face];
  return rangeOf.empty() || chart == LightMapLayout::noChart ? 0 : rangeOf[chart];
}

ChartRanges findChartRanges(const Picture& picture, const LightMapLayout& layout) {
  const std::vector<float> largest = largestOfCharts(picture, layout);
  if (largest.empty()) return {};
  const float most = *std::max_element(largest.begin(), largest.end());
  ChartRanges ranges;
  for (const float value : largest) {
    std::uint8_t range = 0;
    for (float least = most / rangeWidth; value <= least && range + 1u < mostRanges; least /= rangeWidth)
      ++range;
    ranges.rangeOf.push_back(range);
  }
  std::array<std::size_t, mostRanges> texels{};
  for (const LightMapTexel& texel : layout.texels) ++texels[ranges.rangeOf[layout.chartOf[texel.face]]];
  const std::array<std::uint8_t, mostRanges> place = placesOfRanges(texels, layout.texels.size());
  for (std::uint8_t& range : ranges.rangeOf) range = place[range];
  ranges.count = place.back() + 1;
  return ranges;
}

Picture pictureOfRange(const Picture& picture, const LightMapLayout& layout, const ChartRanges& ranges,
                       int range) {
  if (ranges.count == 1) return picture;
  std::vector<bool> filled(layout.texelCount(), false);
  for (const LightMapTexel& texel : layout.texels)
    filled[texel.texel] = ranges.at(layout, texel.face) == range;
  Picture part = picture;
  fillEmptyTexels(part, filled);
  return part;
}

namespace {

/// Returns the value that a hundredth of the colours exceed.
float brightest(const std::vector<glm::vec3>& irradiance) {
  std::vector<float> values;
  values.reserve(irradiance.size());
  for (const glm::vec3& value : irradiance) values.push_back(std::max({value.x, value.y, value.z}));
  if (values.empty()) return 1.0f;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at > 0.0f ? *at : 1.0f;
}

}  // namespace

BakedColors::BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form)
    : scene_(scene), bake_(bake), form_(form) {
  if (form == ExportForm::VertexLight) scale_ = brightest(*bake.irradiance) / std::numbers::pi_v<float>;
}

std::vector<glm::vec4> BakedColors::of(const PrimitiveRange& range, const CompiledMaterial* lamp) const {
  std::vector<glm::vec4> colors;
  colors.reserve(range.vertexCount);
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    glm::vec3 baked = form_ == ExportForm::VertexLight
                          ? (*bake_.irradiance)[v] / (std::numbers::pi_v<float> * scale_)
                          : glm::vec3(bake_.ao[v]);
    const glm::vec4 own = scene_.hasVertexColors() ? scene_.colors[v] : glm::vec4(1.0f);
    baked *= glm::vec3(own);
    if (lamp != nullptr) baked = baked * lamp->baseColor + lamp->emission / scale_;
    colors.push_back(glm::clamp(glm::vec4(baked, own.a), glm::vec4(0.0f), glm::vec4(1.0f)));
  }
  return colors;
}

}  // namespace prelight
