#include "charts/wall_search.h"

#include <algorithm>
#include <numeric>

#include "charts/hidden_places.h"
#include "charts/light_map_lookup.h"
#include "charts/sight_along.h"
#include "charts/texel_grid.h"
#include "receivers/texel_receiver.h"
#include "scene/triangle_weights.h"

namespace prelight {

namespace {

constexpr glm::ivec2 toRight(1, 0), toBelow(0, 1);

class WallFinder {
 public:
  WallFinder(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
             std::span<const std::uint8_t> ignored)
      : scene_(scene), tracer_(tracer), layout_(layout), ignored_(ignored), grid_(layout) {}

  void find() {
    listPairs();
    const std::vector<Obstacle> there = lookAlong(scene_, tracer_, layout_, layout_.texels, pairs_, ignored_);
    std::vector<std::size_t> parted;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (!there[k].seen) parted.push_back(k);
    layout_.walls.clear();
    if (parted.empty()) return;
    layout_.walls.resize(layout_.texelCount());
    setWalls(parted, there);
    markInside();
  }

 private:
  void listPairs() {
    for (std::uint32_t i = 0; i < layout_.texels.size(); ++i)
      for (const glm::ivec2& step : {toRight, toBelow}) {
        const std::uint32_t other = grid_.neighbour(i, step);
        if (other == TexelGrid::none) continue;
        pairs_.push_back({i, other});
        toRight_.push_back(step == toRight ? 1 : 0);
      }
  }

  /// A wall stands in the middle of its two sides.
  void setWalls(const std::vector<std::size_t>& parted, const std::vector<Obstacle>& there) {
    std::vector<PlacePair> back;
    for (const std::size_t k : parted) back.push_back({pairs_[k][1], pairs_[k][0]});
    const std::vector<Obstacle> again = lookAlong(scene_, tracer_, layout_, layout_.texels, back, ignored_);
    for (std::size_t n = 0; n < parted.size(); ++n) {
      const std::size_t k = parted[n];
      const auto [from, to] = pairs_[k];
      const double near = shareAt(from, from, k, there[k].point),
                   far = again[n].seen ? near : shareAt(to, from, k, again[n].point);
      LightMapLayout::Wall& wall = layout_.walls[layout_.texels[from].texel];
      (toRight_[k] != 0 ? wall.right : wall.below) = static_cast<float>(0.5 * (near + far));
      beside_.push_back(from);
      beside_.push_back(to);
    }
  }

  /// How far along the way from one texel's centre to the next a point lies on the map, as the face of texel
  /// `seenFrom` continues there.
  double shareAt(std::uint32_t seenFrom, std::uint32_t from, std::size_t pair, const glm::dvec3& point) const {
    const LightMapTexel& texel = layout_.texels[seenFrom];
    const glm::dvec2 b = triangleWeights(scene_, triangleOf(scene_, texel), point);
    const glm::dvec2 way = lightMapPlace(layout_, texel.face, b.x, b.y) - 0.5 -
                           glm::dvec2(grid_.positionOf(layout_.texels[from].texel));
    return std::clamp(toRight_[pair] != 0 ? way.x : way.y, 0.0, 1.0);
  }

  /// Of texels beside walls, whose squares and those around them are not whole.
  void markInside() {
    std::sort(beside_.begin(), beside_.end());
    beside_.erase(std::unique(beside_.begin(), beside_.end()), beside_.end());
    std::vector<LightMapTexel> places;
    for (const std::uint32_t i : beside_) {
      places.push_back(layout_.texels[i]);
      layout_.texels[i].whole = false;
      grid_.forNeighbours(i, [&](std::uint32_t other, const glm::ivec2&) { layout_.texels[other].whole = false; });
    }
    std::vector<std::uint8_t> marks(places.size(), 0);
    HiddenPlaces(scene_, tracer_, 0).mark(places, marks);
    for (std::size_t k = 0; k < places.size(); ++k) layout_.walls[places[k].texel].inside = marks[k] != 0;
  }

  const CompiledScene& scene_;
  Tracer& tracer_;
  LightMapLayout& layout_;
  std::span<const std::uint8_t> ignored_;
  TexelGrid grid_;
  std::vector<PlacePair> pairs_;  ///< each texel with the next in its row, and with the one below
  std::vector<std::uint8_t> toRight_;
  std::vector<std::uint32_t> beside_;  ///< texels beside a wall
};

}  // namespace

void findWalls(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
               std::span<const std::uint8_t> ignored) {
  WallFinder(scene, tracer, layout, ignored).find();
}

std::vector<std::uint32_t> wallPatches(const LightMapLayout& layout) {
  std::vector<std::uint32_t> patch(layout.texels.size());
  std::iota(patch.begin(), patch.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (patch[i] != i) i = patch[i] = patch[patch[i]];
    return i;
  };
  const TexelGrid grid(layout);
  for (std::uint32_t i = 0; i < patch.size(); ++i)
    for (const glm::ivec2& step : {toRight, toBelow}) {
      const std::uint32_t other = grid.neighbour(i, step);
      if (other == TexelGrid::none) continue;
      if (!layout.walls.empty()) {
        const LightMapLayout::Wall& wall = layout.walls[layout.texels[i].texel];
        if ((step == toRight ? wall.right : wall.below) <= 1.0f) continue;
      }
      const std::uint32_t a = root(i), b = root(other);
      patch[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t i = 0; i < patch.size(); ++i) patch[i] = root(i);
  return patch;
}

}  // namespace prelight
