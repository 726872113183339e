#include "charts/light_map_denoise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/kept_work.h"
#include "charts/wall_search.h"
#include "fit/texel_fill.h"

namespace prelight {

namespace {

constexpr std::size_t leastFilteredTexels = 16;  ///< per chart; fewer show nothing but noise
constexpr int imageMargin = 8;                   ///< least number of texels around a chart
/// Step of the sizes of images, so that many charts share a size.
constexpr int sizeStep = 16;

/// The image of a chart, or of a patch of one that walls divide, with a margin.
struct ChartImage {
  std::vector<std::uint32_t> texels;  ///< texels of the map: y * width + x
  glm::ivec2 origin{0};               ///< position of the image in the map; may lie outside
  glm::ivec2 size{0};
};

std::vector<ChartImage> chartImages(const LightMapLayout& layout) {
  std::vector<ChartImage> charts;
  if (layout.walls.empty()) {
    charts.resize(layout.chartCount);
    for (const LightMapTexel& texel : layout.texels)
      charts[layout.chartOf[texel.face]].texels.push_back(texel.texel);
  } else {
    charts.resize(layout.texels.size());
    const std::vector<std::uint32_t> patches = wallPatches(layout);
    for (std::size_t i = 0; i < patches.size(); ++i)
      charts[patches[i]].texels.push_back(layout.texels[i].texel);
  }
  std::erase_if(charts, [](const ChartImage& chart) { return chart.texels.size() < leastFilteredTexels; });
  const auto width = static_cast<std::uint32_t>(layout.width);
  for (ChartImage& chart : charts) {
    glm::ivec2 least(layout.width, layout.height), most(0);
    for (const std::uint32_t texel : chart.texels) {
      const glm::ivec2 place(texel % width, texel / width);
      least = glm::min(least, place);
      most = glm::max(most, place);
    }
    const glm::ivec2 own = most - least + glm::ivec2(1);
    chart.size = (own + glm::ivec2(2 * imageMargin + sizeStep - 1)) / sizeStep * sizeStep;
    chart.origin = least - (chart.size - own) / 2;
  }
  // Sorted by size, because a filter is set up anew for every size.
  std::stable_sort(charts.begin(), charts.end(), [](const ChartImage& a, const ChartImage& b) {
    return std::tie(a.size.x, a.size.y) < std::tie(b.size.x, b.size.y);
  });
  return charts;
}

/// Returns the bound of |Y_lm| / Y_00 in band l, which also bounds the coefficients of a function that is
/// nowhere negative.
float mostOfBand(int l) { return std::sqrt(2.0f * static_cast<float>(l) + 1.0f); }

/// Denoises the coefficients of one chart, one image after the other.
class ChartDenoiser {
 public:
  ChartDenoiser(Denoiser& denoiser, const Progress& progress, const ChartImage& chart, LightMap& map)
      : denoiser_(denoiser), progress_(progress), chart_(chart), map_(map) {}

  /// Denoises irradiance, or band 0 of incident radiance, and returns its values before and after.
  void denoiseLight(int coefficient, std::vector<glm::vec3>& before, std::vector<glm::vec3>& after) {
    before = valuesOf(coefficient);
    after = filtered(LightMapQuantity::Light, before);
    store(coefficient, after);
  }

  /// Denoises a band l > 0 relative to band 0, because that ratio hardly depends on brightness.
  void denoiseDirections(int coefficient, int l, const std::vector<glm::vec3>& before,
                         const std::vector<glm::vec3>& after) {
    std::vector<glm::vec3> values = valuesOf(coefficient);
    for (std::size_t i = 0; i < values.size(); ++i)
      for (int c = 0; c < 3; ++c)
        values[i][c] = before[i][c] > 0.0f
                           ? std::clamp(values[i][c] / (before[i][c] * mostOfBand(l)), -1.0f, 1.0f)
                           : 0.0f;
    values = filtered(LightMapQuantity::Directions, values);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= after[i] * mostOfBand(l);
    store(coefficient, values);
  }

 private:
  std::size_t placeOf(std::size_t texel, int coefficient, std::size_t channel) const {
    return (3 * texel + channel) * static_cast<std::size_t>(map_.coefficients) +
           static_cast<std::size_t>(coefficient);
  }

  /// Returns [texel of the chart] the values of a coefficient.
  std::vector<glm::vec3> valuesOf(int coefficient) const {
    std::vector<glm::vec3> values;
    values.reserve(chart_.texels.size());
    for (const std::size_t texel : chart_.texels)
      values.emplace_back(map_.values[placeOf(texel, coefficient, 0)],
                          map_.values[placeOf(texel, coefficient, 1)],
                          map_.values[placeOf(texel, coefficient, 2)]);
    return values;
  }

  void store(int coefficient, std::span<const glm::vec3> values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        map_.values[placeOf(chart_.texels[i], coefficient, c)] = values[i][static_cast<int>(c)];
  }

  std::size_t placeInImage(std::size_t texel) const {
    const auto width = static_cast<std::size_t>(map_.layout.width);
    const glm::ivec2 place = glm::ivec2(texel % width, texel / width) - chart_.origin;
    return static_cast<std::size_t>(place.y * chart_.size.x + place.x);
  }

  std::vector<glm::vec3> filtered(LightMapQuantity quantity, std::span<const glm::vec3> values) const {
    const auto area = static_cast<std::size_t>(chart_.size.x * chart_.size.y);
    std::vector<glm::vec3> image(area, glm::vec3(0.0f));
    std::vector<std::uint8_t> filled(area, 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t place = placeInImage(chart_.texels[i]);
      image[place] = values[i];
      filled[place] = 1;
    }
    fillTexels(chart_.size.x, chart_.size.y, 3, filled, std::span(&image.front().x, 3 * area));
    denoiser_.denoise(quantity, chart_.size.x, chart_.size.y, image, progress_);
    std::vector<glm::vec3> clean;
    clean.reserve(values.size());
    for (const std::size_t texel : chart_.texels) clean.push_back(image[placeInImage(texel)]);
    return clean;
  }

  Denoiser& denoiser_;
  const Progress& progress_;
  const ChartImage& chart_;
  LightMap& map_;
};

}  // namespace

void denoiseLightMap(Denoiser& denoiser, const Progress& progress, LightMap& map) {
  const std::vector<ChartImage> images = chartImages(map.layout);
  std::vector<glm::vec3> before, after;
  const auto coefficients = static_cast<std::uint64_t>(map.coefficients);
  std::uint64_t done = 0;  // finished coefficients, over all charts
  WorkPart part(progress, "denoise", [&](auto& state) {
    state.value(done);
    state.values(before);
    state.values(after);
    state.growing(map.values, map.values.size(), done);
    state.requireFinite(map.values);
    state.require(done <= images.size() * coefficients);
    if (done % coefficients < 2) return;  // the first two coefficients need no earlier ones
    const std::size_t texels = images[done / coefficients].texels.size();
    state.require(before.size() == texels && after.size() == texels);
  });
  for (; done < images.size() * coefficients; ++done, part.advance()) {
    progress.check();
    ChartDenoiser chart(denoiser, progress, images[done / coefficients], map);
    const auto i = static_cast<int>(done % coefficients);
    if (i < 2)
      chart.denoiseLight(i, before, after);
    else
      chart.denoiseDirections(i, static_cast<int>(std::sqrt(static_cast<float>(i - 1))), before, after);
  }
  part.finish();
}

}  // namespace prelight
