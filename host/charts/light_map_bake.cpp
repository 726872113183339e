#include "charts/light_map_bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "charts/edge_texels.h"
#include "charts/hidden_light.h"
#include "charts/seam_stitching.h"
#include "charts/wall_search.h"

namespace prelight {

namespace {

constexpr std::size_t blockSize = 4096;  // texels between two looks at whether to stop

/// Irradiance of a texel's values, [channel 3][coefficients].
float channelSum(const float* values, int coefficients) {
  return values[0] + values[coefficients] + values[2 * coefficients];
}

}  // namespace

std::string noteOf(const LightMapLayout& layout, const LightMapReport& report) {
  return fmt::format(
      "light map: {} x {} texels, {:.0f} % of them used by {} charts; {} inside objects; seams differ by "
      "{:.3g} W/m2 rms, {:.3g} before they were stitched",
      layout.width, layout.height,
      100.0 * double(layout.texels.size()) / double(std::max<std::size_t>(1, layout.texelCount())),
      layout.chartCount, report.hidden, report.jumpAfter, report.jumpBefore);
}

LightMapBake::LightMapBake(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout,
                           int coefficients)
    : scene_(scene), tracer_(tracer) {
  map_.layout = std::move(layout);
  findWalls(scene, tracer, map_.layout);
  map_.coefficients = coefficients;
  map_.values.assign(3 * static_cast<std::size_t>(coefficients) * map_.layout.texelCount(), 0.0f);
  hidden_.assign(map_.layout.texels.size(), 0);
  sharp_.assign(map_.layout.texels.size(), 0.0f);
}

void LightMapBake::run(std::span<LightMapPart* const> parts, Progress& progress) {
  const TexelCells cells(scene_, map_.layout);
  const std::size_t count = hidden_.size();
  std::uint64_t earlier = 0;
  const auto raysOf = [&] {
    std::uint64_t sum = 0;
    for (const LightMapPart* part : parts) sum += part->rays();
    return sum;
  };
  // What parts have cast already (photons) counts once, however often the bake goes on.
  if (done_ > 0) earlier = raysOf();
  const auto countRays = [&] {
    const std::uint64_t now = raysOf();
    rays_ += now - earlier;
    earlier = now;
  };
  while (done_ < count) {
    progress.check();
    const std::size_t size = std::min(blockSize, count - done_);
    addBlock(parts, cells, done_, size);
    done_ += size;
    countRays();
    progress.report("light map", static_cast<double>(done_) / static_cast<double>(count));
  }
  const std::vector<std::uint32_t> edges = this->edges();
  while (refined_ < edges.size()) {
    progress.check();
    const std::size_t size = std::min<std::size_t>(blockSize, edges.size() - refined_);
    refineBlock(parts, cells, std::span(edges).subspan(refined_, size));
    refined_ += size;
    countRays();
    progress.report("edges of light", static_cast<double>(refined_) / static_cast<double>(edges.size()));
  }
}

void LightMapBake::addBlock(std::span<LightMapPart* const> parts, const TexelCells& cells, std::size_t first,
                            std::size_t size) {
  const auto texels = std::span(map_.layout.texels).subspan(first, size);
  std::vector<float> values(size * length(), 0.0f);
  const auto lightOf = [&](std::size_t i) { return channelSum(&values[i * length()], map_.coefficients); };
  for (LightMapPart* part : parts) {
    if (part->isSharp())
      for (std::size_t i = 0; i < size; ++i) sharp_[first + i] -= lightOf(i);
    part->addOverCells(texels, cells, map_.coefficients, values, std::span(hidden_).subspan(first, size));
    if (part->isSharp())
      for (std::size_t i = 0; i < size; ++i) sharp_[first + i] += lightOf(i);
  }
  for (std::size_t i = 0; i < size; ++i)
    std::copy_n(&values[i * length()], length(), &map_.values[texels[i].texel * length()]);
}

void LightMapBake::refineBlock(std::span<LightMapPart* const> parts, const TexelCells& cells,
                               std::span<const std::uint32_t> edges) {
  std::vector<LightMapTexel> texels;
  for (const std::uint32_t edge : edges) texels.push_back(map_.layout.texels[edge]);
  std::vector<float> values(edges.size() * length(), 0.0f);
  for (LightMapPart* part : parts) part->refine(texels, cells, map_.coefficients, values);
  corrections_.insert(corrections_.end(), values.begin(), values.end());
}

std::vector<std::uint32_t> LightMapBake::edges() const {
  std::vector<float> all;
  all.reserve(hidden_.size());
  for (const LightMapTexel& texel : map_.layout.texels)
    all.push_back(channelSum(&map_.values[texel.texel * length()], map_.coefficients));
  return edgeTexels(map_.layout, {sharp_, all, hidden_});
}

std::vector<float> LightMapBake::values() const {
  std::vector<float> values(hidden_.size() * length());
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    std::copy_n(&map_.values[map_.layout.texels[i].texel * length()], length(), &values[i * length()]);
  const std::vector<std::uint32_t> edges = this->edges();
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = 0; k < length(); ++k) {
      float& value = values[edges[i] * length() + k];
      value += corrections_[i * length() + k];
      const bool irradiance = k % static_cast<std::size_t>(map_.coefficients) == 0;
      if (irradiance) value = std::max(value, 0.0f);  // which rounding may put below
    }
  return values;
}

void LightMapBake::save(StateWriter& state) const {
  state.value(done_);
  state.value(rays_);
  state.values(hidden_);
  state.values(map_.values);
  state.values(sharp_);
  state.value(refined_);
  state.values(corrections_);
}

void LightMapBake::load(StateReader& state) {
  state.value(done_);
  state.value(rays_);
  state.sameSize(hidden_);
  state.sameSize(map_.values);
  state.sameSize(sharp_);
  state.require(done_ <= hidden_.size());
  for (const std::uint8_t hidden : hidden_) state.require(hidden <= 1);
  state.requireFinite(map_.values);
  state.requireFinite(sharp_);
  state.value(refined_);
  state.require(refined_ <= hidden_.size() && (refined_ == 0 || done_ == hidden_.size()));
  corrections_.resize(refined_ * length());
  state.sameSize(corrections_);
  state.requireFinite(corrections_);
}

LightMap LightMapBake::finish(double creaseAngle, LightMapReport& report,
                              const std::function<void(LightMap&)>& filter) const {
  report.rays = rays_;
  report.hidden = static_cast<std::size_t>(std::count(hidden_.begin(), hidden_.end(), 1));
  LightMap map = map_;  // what is done may still be saved
  const std::vector<float> values = this->values();
  for (std::size_t i = 0; i < hidden_.size(); ++i)
    std::copy_n(&values[i * length()], length(), &map.values[map.layout.texels[i].texel * length()]);
  if (!map.layout.walls.empty())
    for (std::size_t i = 0; i < hidden_.size(); ++i)
      if (hidden_[i] != 0) map.layout.walls[map.layout.texels[i].texel].inside = true;
  fillHidden(hidden_, map);
  if (filter) {
    filter(map);
    fillHidden(hidden_, map);
  }
  const std::vector<SeamPoint> seams = seamsOf(scene_, tracer_, map.layout, creaseAngle);
  report.jumpBefore = seamJump(map, seams);
  stitchSeams(seams, map);
  report.jumpAfter = seamJump(map, seams);
  return map;
}

void keepCoefficients(LightMap& map, int coefficients) {
  const auto before = static_cast<std::size_t>(map.coefficients),
             after = static_cast<std::size_t>(coefficients);
  std::vector<float> kept;
  kept.reserve(map.values.size() / before * after);
  for (std::size_t first = 0; first < map.values.size(); first += before)
    kept.insert(kept.end(), &map.values[first], &map.values[first] + after);
  map.values = std::move(kept);
  map.coefficients = coefficients;
}

}  // namespace prelight
