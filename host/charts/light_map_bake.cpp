#include "charts/light_map_bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "charts/hidden_light.h"
#include "charts/seam_stitching.h"
#include "charts/wall_search.h"

namespace prelight {

namespace {

constexpr std::size_t blockSize = 4096;  // texels between two looks at whether to stop

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
}

void LightMapBake::run(std::span<LightMapPart* const> parts, Progress& progress) {
  const std::size_t length = 3 * static_cast<std::size_t>(map_.coefficients), count = hidden_.size();
  std::uint64_t earlier = 0;
  // What parts have cast already (photons) counts once, however often the bake goes on.
  if (done_ > 0)
    for (const LightMapPart* part : parts) earlier += part->rays();
  std::vector<float> values;
  while (done_ < count) {
    progress.check();
    const std::size_t first = done_, size = std::min(blockSize, count - first);
    const auto texels = std::span(map_.layout.texels).subspan(first, size);
    values.assign(size * length, 0.0f);
    for (LightMapPart* part : parts)
      part->add(texels, map_.coefficients, values, std::span(hidden_).subspan(first, size));
    for (std::size_t i = 0; i < size; ++i)
      std::copy_n(&values[i * length], length, &map_.values[texels[i].texel * length]);
    done_ += size;
    std::uint64_t now = 0;
    for (const LightMapPart* part : parts) now += part->rays();
    rays_ += now - earlier;
    earlier = now;
    progress.report("light map", static_cast<double>(done_) / static_cast<double>(count));
  }
}

void LightMapBake::save(StateWriter& state) const {
  state.value(done_);
  state.value(rays_);
  state.values(hidden_);
  state.values(map_.values);
}

void LightMapBake::load(StateReader& state) {
  state.value(done_);
  state.value(rays_);
  state.sameSize(hidden_);
  state.sameSize(map_.values);
  state.require(done_ <= hidden_.size());
  for (const std::uint8_t hidden : hidden_) state.require(hidden <= 1);
  state.requireFinite(map_.values);
}

LightMap LightMapBake::finish(double creaseAngle, LightMapReport& report,
                              const std::function<void(LightMap&)>& filter) const {
  report.rays = rays_;
  report.hidden = static_cast<std::size_t>(std::count(hidden_.begin(), hidden_.end(), 1));
  LightMap map = map_;  // what is done may still be saved
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
