#include "integrators/virtual_light_power.h"

#include <algorithm>
#include <limits>

#include "base/colour.h"
#include "base/parallel.h"

namespace prelight {

using namespace device;

namespace {

constexpr std::uint64_t manyPaths = std::uint64_t{1} << 14;
constexpr std::uint32_t raysOfMany = 1;
constexpr std::size_t lightsAtOnce = 256;  ///< many lights that a thread processes at a time
constexpr double mostFactor = 4.0;

glm::vec3 vectorOf(const float (&xyz)[3]) { return {xyz[0], xyz[1], xyz[2]}; }

void add(const float (&term)[3], float (&sum)[3]) {
  for (int c = 0; c < 3; ++c) sum[c] += term[c];
}

void scale(double factor, float (&value)[3]) {
  for (float& v : value) v = static_cast<float>(factor * double{v});
}

PhotonRequest manyOf(const PhotonRequest& paths) {
  PhotonRequest many = paths;
  many.photons = manyPaths;
  many.seed = paths.seed ^ 0x6a09e667f3bcc909u;
  many.flights = false;
  return many;
}

/// Returns a distance between two lights, which is larger if they face different directions.
float distanceBetween(const VirtualLight& one, const VirtualLight& other) {
  const glm::vec3 way = vectorOf(one.position) - vectorOf(other.position);
  const float turned = 1.0f - glm::dot(vectorOf(one.geometric), vectorOf(other.geometric));
  constexpr float ofTurns = 16.0f;
  return glm::dot(way, way) * (1.0f + ofTurns * turned);
}

/// Returns the index of the nearest light for each of the many lights.
std::vector<std::uint32_t> nearestOf(std::span<const VirtualLight> many,
                                     std::span<const VirtualLight> lights) {
  std::vector<std::uint32_t> nearest(many.size());
  parallelRanges(many.size(), lightsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float least = std::numeric_limits<float>::infinity();
      for (std::size_t k = 0; k < lights.size(); ++k) {
        const float distance = distanceBetween(many[i], lights[k]);
        if (!(distance < least)) continue;
        least = distance;
        nearest[i] = static_cast<std::uint32_t>(k);
      }
    }
  });
  return nearest;
}

}  // namespace

VirtualLightPower::VirtualLightPower(const CompiledScene& compiled, TransportScene& scene,
                                     const PhotonRequest& paths, const BuildOptions& options)
    : compiled_(compiled),
      request_(manyOf(paths)),
      tracer_(compiled, scene),
      maker_(scene, options),
      reach_(scene, options) {}

void VirtualLightPower::trace(Progress& progress) {
  PhotonHits hits;
  tracer_.trace(request_, hits, progress);
  many_.resize(hits.photons.size());
  met_ = glm::dvec3(0.0);
  if (many_.empty()) return;
  maker_.make(hits.photons).read(std::span(many_));
  const std::vector<float> distances = reach_.distances(maker_.lights(), many_.size(), raysOfMany);
  for (std::size_t i = 0; i < many_.size(); ++i)
    if (distances[i] < VirtualLightReach::nothing) met_ += glm::dvec3(vectorOf(many_[i].intensity));
}

void VirtualLightPower::share(std::span<VirtualLight> lights, float leastSquare) {
  if (lights.empty() || many_.empty()) return;
  const std::vector<std::uint32_t> nearest = nearestOf(many_, lights);
  for (VirtualLight& light : lights)
    for (int c = 0; c < 3; ++c) light.intensity[c] = light.through[c] = 0.0f;
  for (std::size_t i = 0; i < many_.size(); ++i) {
    add(many_[i].intensity, lights[nearest[i]].intensity);
    add(many_[i].through, lights[nearest[i]].through);
  }
  const std::vector<double> shares = reach_.setNear(lights, leastSquare);
  glm::dvec3 meets(0.0);
  for (std::size_t k = 0; k < lights.size(); ++k)
    meets += shares[k] * glm::dvec3(vectorOf(lights[k].intensity));
  if (!(luminance(meets) > 0.0)) return;
  const double factor = std::clamp(luminance(met_) / luminance(meets), 1.0 / mostFactor, mostFactor);
  for (VirtualLight& light : lights) scale(factor, light.intensity);
}

}  // namespace prelight
