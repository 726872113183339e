#include "charts/wall_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "charts/first_obstacles.h"
#include "charts/hidden_light.h"
#include "charts/light_map_lookup.h"
#include "charts/texel_grid.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

/// Height of the upper ray, as a share of the distance between the two places.
constexpr double upperHeight = 0.05;

constexpr std::size_t pairsAtOnce = std::size_t{1} << 17;

class SightFinder {
 public:
  SightFinder(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
              std::span<const LightMapTexel> places, std::span<const std::uint8_t> ignored)
      : scene_(scene), tracer_(tracer), layout_(layout), places_(places), ignored_(ignored) {}

  /// Finds obstacles at a height for the pairs without a known obstacle.
  void look(std::span<const PlacePair> pairs, double height, std::span<Obstacle> obstacles) {
    std::vector<std::uint32_t> waiting;
    std::vector<device::Ray> rays;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      if (!obstacles[i].seen) continue;
      const device::Ray ray = rayOf(pairs[i], height);
      if (ray.direction[0] == 0.0f && ray.direction[1] == 0.0f && ray.direction[2] == 0.0f) continue;
      waiting.push_back(i);
      rays.push_back(ray);
    }
    const std::vector<device::Hit> hits = firstObstacles(
        tracer_, rays,
        [&](std::size_t k, std::uint32_t triangle) { return hidesNothing(triangle, pairs[waiting[k]]); });
    for (std::size_t k = 0; k < waiting.size(); ++k)
      if (hits[k].triangle != PRELIGHT_NO_TRIANGLE)
        obstacles[waiting[k]] = {false, pointOf(rays[k], hits[k]), hits[k].triangle};
  }

 private:
  device::Ray rayOf(const PlacePair& pair, double height) const {
    const device::Receiver from = receiverAt(scene_, places_[pair[0]]),
                           to = receiverAt(scene_, places_[pair[1]]);
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double way = double(to.position[k]) - double(from.position[k]);
      squared += way * way;
    }
    const double lift = height * std::sqrt(squared);
    device::Ray ray{};
    for (int k = 0; k < 3; ++k) {
      const double start = from.position[k] + lift * from.geometricNormal[k],
                   end = to.position[k] + lift * to.geometricNormal[k];
      ray.origin[k] = static_cast<float>(start);
      ray.direction[k] = static_cast<float>(end - static_cast<double>(ray.origin[k]));
    }
    ray.sourceTriangle = from.triangle;
    ray.tMax = 1.0f;
    return ray;
  }

  bool hidesNothing(std::uint32_t triangle, const PlacePair& pair) const {
    if (!ignored_.empty() && ignored_[triangle] != 0) return true;
    for (const std::uint32_t place : pair) {
      const std::uint32_t chart = layout_.chartOf[places_[place].face];
      if (layout_.chartOf[triangle] == chart || layout_.chartOf[scene_.triangleCount() + triangle] == chart)
        return true;
    }
    return false;
  }

  static glm::dvec3 pointOf(const device::Ray& ray, const device::Hit& hit) {
    glm::dvec3 point;
    for (int k = 0; k < 3; ++k) point[k] = double(ray.origin[k]) + double(hit.t) * double(ray.direction[k]);
    return point;
  }

  const CompiledScene& scene_;
  Tracer& tracer_;
  const LightMapLayout& layout_;
  std::span<const LightMapTexel> places_;
  std::span<const std::uint8_t> ignored_;
};

}  // namespace

std::vector<Obstacle> lookAlong(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                                std::span<const LightMapTexel> places, std::span<const PlacePair> pairs,
                                std::span<const std::uint8_t> ignored) {
  SightFinder finder(scene, tracer, layout, places, ignored);
  std::vector<Obstacle> obstacles(pairs.size());
  for (std::size_t first = 0; first < pairs.size(); first += pairsAtOnce) {
    const std::size_t count = std::min(pairsAtOnce, pairs.size() - first);
    for (const double height : {0.0, upperHeight})
      finder.look(pairs.subspan(first, count), height, std::span(obstacles).subspan(first, count));
  }
  return obstacles;
}

namespace {

constexpr glm::ivec2 toRight(1, 0), toBelow(0, 1);

/// The plane of a texel's face, and the map's axes on it.
class MapFrame {
 public:
  MapFrame(const CompiledScene& scene, const LightMapLayout& layout, const LightMapTexel& texel)
      : scene_(scene), layout_(layout), face_(texel.face), triangle_(triangleOf(scene, texel)) {
    const glm::vec2* c = &layout.corners[3 * std::size_t{face_}];
    const glm::dmat2 places(glm::dvec2(c[1] - c[0]), glm::dvec2(c[2] - c[0]));
    const glm::uvec3& t = scene.triangles[triangle_];
    const glm::dvec3 a(scene.positions[t.x]), e = glm::dvec3(scene.positions[t.y]) - a,
                                              f = glm::dvec3(scene.positions[t.z]) - a;
    if (!(std::abs(glm::determinant(places)) > 0.0)) return;
    const glm::dmat2 weights =
        glm::inverse(places);  // weights of corners 1 and 2 per column and row of the map
    column_ = weights[0][0] * e + weights[0][1] * f;
    row_ = weights[1][0] * e + weights[1][1] * f;
  }

  glm::dvec2 placeOf(const glm::dvec3& point) const {
    const glm::dvec2 b = triangleWeights(scene_, triangle_, point);
    return lightMapPlace(layout_, face_, b.x, b.y);
  }

  /// Returns how fast the product with a vector in space grows along the map's columns and rows.
  glm::dvec2 gradient(const glm::dvec3& vector) const {
    return {glm::dot(vector, column_), glm::dot(vector, row_)};
  }

 private:
  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  std::uint32_t face_, triangle_;
  glm::dvec3 column_{0.0}, row_{0.0};  ///< m per texel
};

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

  /// Sets the walls of pairs; a wall stands halfway between its two sides.
  void setWalls(const std::vector<std::size_t>& parted, const std::vector<Obstacle>& there) {
    std::vector<PlacePair> back;
    for (const std::size_t k : parted) back.push_back({pairs_[k][1], pairs_[k][0]});
    const std::vector<Obstacle> again = lookAlong(scene_, tracer_, layout_, layout_.texels, back, ignored_);
    for (std::size_t n = 0; n < parted.size(); ++n) {
      const std::size_t k = parted[n];
      const auto [from, to] = pairs_[k];
      const double near = shareAt(from, k, there[k]), far = again[n].seen ? near : shareAt(to, k, again[n]);
      LightMapLayout::Wall& wall = layout_.walls[layout_.texels[from].texel];
      (toRight_[k] != 0 ? wall.right : wall.below) = static_cast<float>(0.5 * (near + far));
      beside_.push_back(from);
      beside_.push_back(to);
    }
  }

  /// Returns how far between a pair's centres on the map a wall stands, as a share. Places may lie a little
  /// off the centres, so the obstacle is followed along its own plane to the line between the centres.
  /// `texel`: the one whose face defines the map's plane.
  double shareAt(std::uint32_t texel, std::size_t pair, const Obstacle& obstacle) const {
    const MapFrame frame(scene_, layout_, layout_.texels[texel]);
    const glm::dvec2 met = frame.placeOf(obstacle.point) - 0.5 -
                           glm::dvec2(grid_.positionOf(layout_.texels[pairs_[pair][0]].texel));
    const glm::dvec2 across = frame.gradient(geometricNormal(scene_, obstacle.triangle));
    const int along = toRight_[pair] != 0 ? 0 : 1, aside = 1 - along;
    constexpr double steepest = 0.05;  // walls nearly parallel to the line are not followed
    double share = met[along];
    if (std::abs(across[along]) > steepest * glm::length(across))
      share += across[aside] * met[aside] / across[along];
    return std::clamp(share, 0.0, 1.0);
  }

  /// Marks texels beside walls that lie inside objects; neither their squares nor those around them are
  /// whole.
  void markInside() {
    std::sort(beside_.begin(), beside_.end());
    beside_.erase(std::unique(beside_.begin(), beside_.end()), beside_.end());
    std::vector<LightMapTexel> places;
    for (const std::uint32_t i : beside_) {
      places.push_back(layout_.texels[i]);
      layout_.texels[i].whole = false;
      grid_.forNeighbours(
          i, [&](std::uint32_t other, const glm::ivec2&) { layout_.texels[other].whole = false; });
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
