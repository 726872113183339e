#include "lightmap/light_map_bake.h"

#include <fmt/format.h>
#include <algorithm>

#include "lightmap/seam_stitching.h"

namespace prelight {

namespace {

constexpr std::size_t blockSize = 4096;  // texels between two looks at whether to stop

/// Grows rings of values into hidden texels.
class HiddenFiller {
 public:
  HiddenFiller(std::vector<std::uint8_t> hidden, LightMap& map)
      : hidden_(std::move(hidden)), map_(map), placeOf_(map.layout.texelCount(), none) {
    for (std::uint32_t i = 0; i < map.layout.texels.size(); ++i) placeOf_[map.layout.texels[i].texel] = i;
  }

  void run() {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < hidden_.size(); ++i)
      if (hidden_[i]) waiting.push_back(i);
    for (bool changed = true; changed && !waiting.empty();) {
      std::vector<std::uint32_t> ring, rest;
      for (const std::uint32_t place : waiting) (takeMean(place) ? ring : rest).push_back(place);
      for (const std::uint32_t place : ring) hidden_[place] = 0;
      changed = !ring.empty();
      waiting = std::move(rest);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  std::uint32_t chartOf(std::uint32_t place) const {
    return map_.layout.chartOf[map_.layout.texels[place].face];
  }

  /// False when no neighbour has a value.
  bool takeMean(std::uint32_t place) {
    const std::size_t length = 3 * static_cast<std::size_t>(map_.coefficients);
    const auto width = static_cast<std::uint32_t>(map_.layout.width);
    const std::uint32_t texel = map_.layout.texels[place].texel;
    const int x = static_cast<int>(texel % width), y = static_cast<int>(texel / width);
    std::vector<float> sum(length, 0.0f);
    float count = 0.0f;
    for (int row = std::max(0, y - 1); row <= std::min(map_.layout.height - 1, y + 1); ++row)
      for (int column = std::max(0, x - 1); column <= std::min(map_.layout.width - 1, x + 1); ++column) {
        const std::uint32_t other =
            placeOf_[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
        if (other == none || hidden_[other] || chartOf(other) != chartOf(place)) continue;
        count += 1.0f;
        for (std::size_t i = 0; i < length; ++i)
          sum[i] += map_.values[map_.layout.texels[other].texel * length + i];
      }
    if (count == 0.0f) return false;
    for (std::size_t i = 0; i < length; ++i) map_.values[texel * length + i] = sum[i] / count;
    return true;
  }

  std::vector<std::uint8_t> hidden_;
  LightMap& map_;
  std::vector<std::uint32_t> placeOf_;  ///< [texel], or none
};

}  // namespace

LightMapBake::LightMapBake(const CompiledScene& scene, LightMapLayout layout, int coefficients)
    : scene_(scene) {
  map_.layout = std::move(layout);
  map_.coefficients = coefficients;
  map_.values.assign(3 * static_cast<std::size_t>(coefficients) * map_.layout.texelCount(), 0.0f);
  hidden_.assign(map_.layout.texels.size(), 0);
}

void LightMapBake::run(std::span<LightMapPart* const> parts, Progress& progress) {
  const std::size_t length = 3 * static_cast<std::size_t>(map_.coefficients), count = hidden_.size();
  std::uint64_t earlier = 0;
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
}

LightMap LightMapBake::finish(double creaseAngle, LightMapReport& report) {
  report.rays = rays_;
  report.hidden = static_cast<std::size_t>(std::count(hidden_.begin(), hidden_.end(), 1));
  fillHidden(hidden_, map_);
  const std::vector<SeamPoint> seams = seamsOf(scene_, map_.layout, creaseAngle);
  report.jumpBefore = seamJump(map_, seams);
  stitchSeams(seams, map_);
  report.jumpAfter = seamJump(map_, seams);
  return std::move(map_);
}

void fillHidden(std::vector<std::uint8_t> hidden, LightMap& map) {
  HiddenFiller(std::move(hidden), map).run();
}

}  // namespace prelight
