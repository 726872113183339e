#include "viewer/cubes/outside_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/surface/triangles.h"

namespace prelight::viewer {
namespace {

constexpr std::uint32_t mostSamples = 48;  ///< of a node's surface, altogether

/// Directions along no edge that anybody would model.
const std::array<glm::dvec3, 3> probeDirections = {
    {{0.5773, 0.6461, 0.4992}, {-0.7352, 0.2113, 0.6441}, {0.1287, -0.8219, -0.5549}}};

bool crossesOddly(const CompiledScene& scene, const TwoSidedBody& body, const glm::dvec3& from,
                  const glm::dvec3& direction) {
  bool odd = false;
  for (const TriangleRange& range : body.triangles)
    for (std::uint32_t t = 0; t < range.count; ++t)
      odd = odd != (distanceTo(scene, range.first + t, from, direction).value_or(0.0) > 0.0);
  return odd;
}

struct Sample {
  glm::dvec3 place;
  double area;
};

/// Centroids of triangles, evenly over their numbers.
std::vector<Sample> samplesOf(const CompiledScene& scene, const std::vector<TriangleRange>& own) {
  std::uint32_t count = 0;
  for (const TriangleRange& range : own) count += range.count;
  const std::uint32_t step = std::max(1u, (count + mostSamples - 1) / mostSamples);
  std::uint32_t next = 0;  // of the range at hand
  std::vector<Sample> samples;
  for (const TriangleRange& range : own) {
    for (; next < range.count; next += step) {
      const glm::uvec3& corners = scene.triangles[range.first + next];
      glm::dvec3 sum(0.0);
      for (int k = 0; k < 3; ++k) sum += glm::dvec3(scene.positions[corners[k]]);
      samples.push_back({sum / 3.0, 0.5 * glm::length(geometricNormal(scene, range.first + next))});
    }
    next -= range.count;
  }
  return samples;
}

}  // namespace

bool liesWithin(const CompiledScene& scene, const TwoSidedBody& body, const glm::vec3& point) {
  if (glm::any(glm::lessThan(point, body.lower)) || glm::any(glm::greaterThan(point, body.upper)))
    return false;
  int odd = 0;
  for (const glm::dvec3& direction : probeDirections)
    odd += crossesOddly(scene, body, glm::dvec3(point), direction) ? 1 : 0;
  return odd >= 2;
}

glm::vec3 placeOutside(const CompiledScene& scene, const std::vector<TriangleRange>& own,
                       const glm::vec3& center, const std::vector<TwoSidedBody>& bodies) {
  std::vector<const TwoSidedBody*> around;
  for (const TwoSidedBody& body : bodies)
    if (liesWithin(scene, body, center)) around.push_back(&body);
  if (around.empty()) return center;
  const auto isFree = [&](const glm::dvec3& place) {
    return std::none_of(around.begin(), around.end(),
                        [&](const TwoSidedBody* body) { return liesWithin(scene, *body, glm::vec3(place)); });
  };
  std::vector<Sample> outside;
  Sample middle{glm::dvec3(0.0), 0.0};
  for (const Sample& sample : samplesOf(scene, own)) {
    if (!isFree(sample.place)) continue;
    outside.push_back(sample);
    middle.place += sample.area * sample.place;
    middle.area += sample.area;
  }
  if (!(middle.area > 0.0)) return center;
  if (const glm::dvec3 mean = middle.place / middle.area; isFree(mean)) return glm::vec3(mean);
  // The first of the nearest: of places that are as near as each other rounding would choose.
  constexpr double asNear = 1.05;
  double least = 1e300;
  for (const Sample& sample : outside)
    least = std::min(least, glm::distance(sample.place, glm::dvec3(center)));
  const auto nearest = std::find_if(outside.begin(), outside.end(), [&](const Sample& sample) {
    return glm::distance(sample.place, glm::dvec3(center)) <= asNear * least;
  });
  return glm::vec3(nearest->place);
}

}  // namespace prelight::viewer
