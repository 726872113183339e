#include "charts/sight_along.h"

#include <algorithm>
#include <cmath>

#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

/// Height of the upper ray, as a share of the distance between the two places.
constexpr double upperHeight = 0.05;

/// Number of ignored triangles that a ray may pass before it counts as blocked.
constexpr int mostPassed = 16;

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
    for (int passed = 0; !waiting.empty(); ++passed) {
      const std::vector<device::Hit> hits = tracer_.traceClosest(rays);
      std::size_t kept = 0;
      for (std::size_t k = 0; k < waiting.size(); ++k) {
        const std::uint32_t i = waiting[k], triangle = hits[k].triangle;
        if (triangle == PRELIGHT_NO_TRIANGLE) continue;
        if (passed < mostPassed && hidesNothing(triangle, pairs[i])) {
          rays[kept] = beyond(rays[k], hits[k]);
          waiting[kept++] = i;
        } else {
          obstacles[i] = {false, pointOf(rays[k], hits[k]), triangle};
        }
      }
      waiting.resize(kept);
      rays.resize(kept);
    }
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

  static device::Ray beyond(device::Ray ray, const device::Hit& hit) {
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] += hit.t * ray.direction[k];
      ray.direction[k] *= 1.0f - hit.t;
    }
    ray.sourceTriangle = hit.triangle;
    return ray;
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

}  // namespace prelight
