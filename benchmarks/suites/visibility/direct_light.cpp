#include "benchmarks/suites/visibility/direct_light.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "base/parallel.h"
#include "benchmarks/run/measure.h"
#include "scene/closed_bodies.h"

namespace prelight::benchmarks {

namespace {

constexpr double rayOffset = 1e-5;  // as a share of the bounds' diagonal, along the normal

/// Returns a number in [0,1). It is the same on every machine, unlike those of the standard library's
/// distributions.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

using LitPlace = DirectLight::LitPlace;

double cosineTo(const LitPlace& receiver, const glm::dvec3& light) {
  return std::max(glm::dot(receiver.normal, glm::normalize(light - receiver.position)), 0.0);
}

/// Returns [place] 1 if a place lies inside an opaque solid: a ray along its normal first hits the solid's
/// back.
std::vector<std::uint8_t> insideSolids(const CompiledScene& scene, Tracer& tracer,
                                       const std::vector<LitPlace>& places, double offset) {
  std::vector<std::uint8_t> inside(places.size(), 0);
  const std::vector<std::uint8_t> solid = trianglesOfEnteredSolids(scene);
  if (solid.empty()) return inside;
  const double reach = 2.0 * glm::distance(scene.boundsMin, scene.boundsMax);
  std::vector<device::Ray> rays;
  for (const LitPlace& place : places)
    rays.push_back(
        rayFrom(place.position + offset * place.normal, place.normal, PRELIGHT_NO_TRIANGLE, reach));
  const std::vector<device::Hit> hits = tracer.traceClosest(rays);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (hits[i].triangle != PRELIGHT_NO_TRIANGLE && solid[hits[i].triangle] != 0)
      inside[i] = glm::dot(geometricNormal(scene, hits[i].triangle), places[i].normal) > 0.0 ? 1 : 0;
  return inside;
}

/// Returns [receiver] 1 if nothing lies between the receiver and the light.
std::vector<std::uint8_t> traceShadows(Tracer& tracer, const std::vector<LitPlace>& receivers,
                                       const glm::dvec3& light, double offset) {
  std::vector<device::Ray> rays;
  rays.reserve(receivers.size());
  for (const LitPlace& receiver : receivers) {
    const glm::dvec3 path = light - receiver.position;
    const double distance = glm::length(path);
    rays.push_back(rayFrom(receiver.position + offset * receiver.normal, path / distance,
                           PRELIGHT_NO_TRIANGLE, distance - 2.0 * offset));
  }
  const std::vector<device::Hit> hits = tracer.traceAny(rays);
  std::vector<std::uint8_t> visible;
  for (const device::Hit& hit : hits) visible.push_back(hit.triangle == PRELIGHT_NO_TRIANGLE ? 1 : 0);
  return visible;
}

}  // namespace

DirectLight::DirectLight(const CompiledScene& scene, Tracer& tracer, std::vector<glm::dvec3> lights,
                         std::size_t points, std::uint64_t seed)
    : scene_(scene), lights_(std::move(lights)) {
  const double offset = rayOffset * glm::distance(scene.boundsMin, scene.boundsMax);
  chooseSamples(points, seed);
  dropHiddenSamples(tracer, offset);
  const std::vector<LitPlace> places = samplePlaces();
  std::vector<LitPlace> vertices;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    vertices.push_back({glm::dvec3(scene.positions[v]), glm::dvec3(scene.normals[v])});
  for (const glm::dvec3& light : lights_) {
    const std::vector<std::uint8_t> visible = traceShadows(tracer, places, light, offset);
    std::vector<double>& truth = truth_.emplace_back();
    for (std::size_t s = 0; s < places.size(); ++s)
      truth.push_back(visible[s] != 0 ? cosineTo(places[s], light) : 0.0);
    vertexVisible_.push_back(traceShadows(tracer, vertices, light, offset));
  }
}

void DirectLight::chooseSamples(std::size_t points, std::uint64_t seed) {
  std::vector<double> areas;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
    areas.push_back(sum += 0.5 * glm::length(geometricNormal(scene_, t)));
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < points; ++i) {
    const auto chosen = std::upper_bound(areas.begin(), areas.end() - 1, uniform(random) * sum);
    const glm::uvec3 corners = scene_.triangles[static_cast<std::size_t>(chosen - areas.begin())];
    double u = uniform(random), v = uniform(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec3 weights(1.0 - u - v, u, v);
    const auto mix = [&](const std::vector<glm::vec3>& values) {
      return weights.x * glm::dvec3(values[corners.x]) + weights.y * glm::dvec3(values[corners.y]) +
             weights.z * glm::dvec3(values[corners.z]);
    };
    samples_.push_back({corners, weights, mix(scene_.positions), glm::normalize(mix(scene_.normals))});
  }
}

std::vector<DirectLight::LitPlace> DirectLight::samplePlaces() const {
  std::vector<LitPlace> places;
  for (const Sample& sample : samples_) places.push_back({sample.position, sample.normal});
  return places;
}

void DirectLight::dropHiddenSamples(Tracer& tracer, double offset) {
  const std::vector<std::uint8_t> hidden = insideSolids(scene_, tracer, samplePlaces(), offset);
  std::vector<Sample> seen;
  for (std::size_t s = 0; s < samples_.size(); ++s)
    if (hidden[s] == 0) seen.push_back(samples_[s]);
  samples_ = std::move(seen);
}

double DirectLight::error(const Visibility& visibility) const {
  std::vector<double> squares(lights_.size(), 0.0);
  parallelRanges(lights_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t light = begin; light < end; ++light) {
      std::vector<double> shown;
      for (std::uint32_t v = 0; v < scene_.vertexCount(); ++v) {
        const LitPlace vertex{glm::dvec3(scene_.positions[v]), glm::dvec3(scene_.normals[v])};
        const double cosine = cosineTo(vertex, lights_[light]);
        shown.push_back(cosine > 0.0 ? cosine * visibility(light, v) : 0.0);
      }
      for (std::size_t s = 0; s < samples_.size(); ++s) {
        const Sample& sample = samples_[s];
        const glm::dvec3 corners(shown[sample.corners.x], shown[sample.corners.y], shown[sample.corners.z]);
        const double difference = glm::dot(sample.weights, corners) - truth_[light][s];
        squares[light] += difference * difference;
      }
    }
  });
  double sum = 0.0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / static_cast<double>(lights_.size() * samples_.size()));
}

}  // namespace prelight::benchmarks
