#include "charts/hidden_light.h"

#include <algorithm>

#include "base/colour.h"
#include "charts/texel_grid.h"
#include "charts/wall_search.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

class HiddenFiller {
 public:
  /// `walled`: values do not spread across walls.
  HiddenFiller(const LightMapLayout& layout, std::size_t length, std::span<const std::uint8_t> hidden,
               std::span<float> values, bool walled)
      : layout_(layout),
        length_(length),
        values_(values),
        walled_(walled && !layout.walls.empty()),
        grid_(layout),
        empty_(hidden.begin(), hidden.end()) {}

  /// Fills ring by ring, so that neighbours filled in one ring do not affect one another.
  void fill() {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < empty_.size(); ++i)
      if (empty_[i] != 0) waiting.push_back(i);
    while (!waiting.empty()) {
      std::vector<PlacePair> ring;  // a texel and the neighbour whose values it takes
      for (const std::uint32_t i : waiting) {
        const std::uint32_t darkest = darkestAround(i);
        if (darkest != TexelGrid::none) ring.push_back({i, darkest});
      }
      for (const auto& [i, from] : ring) {
        std::copy_n(&values_[length_ * from], length_, &values_[length_ * i]);
        empty_[i] = 0;
      }
      waiting = emptyAround(ring);
    }
  }

 private:
  double lightAt(std::uint32_t i) const { return lightOf(values_.subspan(length_ * i, length_)); }

  /// Returns the darkest of the neighbours that are not empty.
  std::uint32_t darkestAround(std::uint32_t i) const {
    std::uint32_t darkest = TexelGrid::none;
    grid_.forNeighbours(i, [&](std::uint32_t other, const glm::ivec2& step) {
      if (walled_ && isParted(i, other, step)) return;
      if (empty_[other] == 0 && (darkest == TexelGrid::none || lightAt(other) < lightAt(darkest)))
        darkest = other;
    });
    return darkest;
  }

  /// Returns true when a wall may stand between two neighbours; for diagonal neighbours this is not known.
  bool isParted(std::uint32_t i, std::uint32_t other, const glm::ivec2& step) const {
    if (step.x != 0 && step.y != 0) return true;
    const std::uint32_t first = step.x + step.y > 0 ? i : other;
    const LightMapLayout::Wall& wall = layout_.walls[layout_.texels[first].texel];
    return (step.x != 0 ? wall.right : wall.below) <= 1.0f;
  }

  std::vector<std::uint32_t> emptyAround(std::span<const PlacePair> ring) const {
    std::vector<std::uint32_t> around;
    for (const PlacePair& filled : ring)
      grid_.forNeighbours(filled[0], [&](std::uint32_t other, const glm::ivec2&) {
        if (empty_[other] != 0) around.push_back(other);
      });
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
  }

  const LightMapLayout& layout_;
  std::size_t length_;
  std::span<float> values_;
  bool walled_;
  TexelGrid grid_;
  std::vector<std::uint8_t> empty_;
};

}  // namespace

double lightOf(std::span<const float> values) {
  const std::size_t third = values.size() / 3;
  return luminance(glm::dvec3(values[0], values[third], values[2 * third]));
}

void fillHidden(const LightMapLayout& layout, std::size_t length, std::span<const std::uint8_t> hidden,
                std::span<float> values) {
  if (std::find(hidden.begin(), hidden.end(), 1) == hidden.end()) return;
  HiddenFiller(layout, length, hidden, values, false).fill();
}

namespace {

void fillMap(std::span<const std::uint8_t> hidden, bool walled, LightMap& map) {
  if (std::find(hidden.begin(), hidden.end(), 1) == hidden.end()) return;
  const std::size_t length = 3 * static_cast<std::size_t>(map.coefficients);
  std::vector<float> values(length * map.layout.texels.size());
  for (std::size_t i = 0; i < map.layout.texels.size(); ++i)
    std::copy_n(&map.values[length * map.layout.texels[i].texel], length, &values[length * i]);
  HiddenFiller(map.layout, length, hidden, values, walled).fill();
  for (std::size_t i = 0; i < map.layout.texels.size(); ++i)
    if (hidden[i] != 0)
      std::copy_n(&values[length * i], length, &map.values[length * map.layout.texels[i].texel]);
}

}  // namespace

void fillHidden(std::span<const std::uint8_t> hidden, LightMap& map) { fillMap(hidden, false, map); }

void fillBlack(LightMap& map) {
  std::vector<std::uint8_t> black;
  for (const LightMapTexel& texel : map.layout.texels) {
    const float* value = &map.values[3 * std::size_t{texel.texel}];
    black.push_back(value[0] == 0.0f && value[1] == 0.0f && value[2] == 0.0f ? 1 : 0);
  }
  fillMap(black, true, map);
}

void setIrradiance(std::span<const glm::vec3> irradiance, LightMap& map) {
  const LightMapLayout& layout = map.layout;
  std::vector<std::uint8_t> hidden(irradiance.size(), 0);
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const std::size_t texel = layout.texels[i].texel;
    for (std::size_t c = 0; c < 3; ++c) map.values[3 * texel + c] = irradiance[i][static_cast<int>(c)];
    hidden[i] = !layout.walls.empty() && layout.walls[texel].inside ? 1 : 0;
  }
  fillHidden(hidden, map);
}

namespace {

CastOptions castOptions() {
  CastOptions options;
  options.raysPerReceiver = HiddenPlaces::raysPerPlace;
  options.marksInside = true;
  return options;
}

}  // namespace

HiddenPlaces::HiddenPlaces(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed)
    : scene_(scene),
      caster_(scene, tracer, castOptions()),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x1d5e7u))) {
}

void HiddenPlaces::mark(std::span<const LightMapTexel> places, std::span<std::uint8_t> marks) {
  for (std::size_t first = 0; first < places.size(); first += caster_.blockSize()) {
    const auto block =
        places.subspan(first, std::min<std::size_t>(caster_.blockSize(), places.size() - first));
    receivers_.clear();
    for (const LightMapTexel& place : block) {
      receivers_.push_back(receiverAt(scene_, place));
      receivers_.back().seed = seed_ ^ sampling::hashInteger(place.texel);
    }
    caster_.cast(receivers_, cast_);
    for (std::size_t i = 0; i < block.size(); ++i)
      if (cast_.inside[i] != 0) marks[first + i] = 1;
  }
}

}  // namespace prelight
