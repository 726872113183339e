#include "benchmarks/truth/traced_accessibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "benchmarks/run/measure.h"
#include "benchmarks/truth/seen_places.h"

namespace prelight::benchmarks {
namespace {

constexpr double goldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);
constexpr std::size_t pixelsAtOnce = 1024;

/// Returns direction `index` of `count` on a turned spiral; their density about z is that of the cosine.
glm::dvec3 spiral(int index, int count, double turn) {
  const double share = (index + 0.5) / count, r = std::sqrt(share);
  const double azimuth = index * goldenAngle + turn;
  return {r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1.0 - share)};
}

glm::dmat3 frameAbout(const glm::dvec3& z) {
  const glm::dvec3 x =
      glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  return {x, glm::cross(z, x), z};
}

/// Parameters of rays that start at places.
struct Gathering {
  Tracer& tracer;
  double offset = 0.0;  ///< distance above a place at which its rays begin, m
  double radius = 0.0;  ///< m
  int rays = 0;         ///< per place
};

/// Returns rays of the places first to last, cosine-distributed about the shading normal. `owners` receive
/// the place of each ray.
std::vector<device::Ray> raysFrom(std::span<const SeenPlace> places, std::size_t first,
                                  const Gathering& gathering, std::vector<std::size_t>& owners) {
  std::vector<device::Ray> rays;
  for (std::size_t i = first; i < std::min(first + pixelsAtOnce, places.size()); ++i) {
    const SeenPlace& place = places[i];
    if (place.triangle == PRELIGHT_NO_TRIANGLE) continue;
    const glm::dmat3 frame = frameAbout(place.normal);
    for (int k = 0; k < gathering.rays; ++k) {
      const glm::dvec3 way = frame * spiral(k, gathering.rays, 2.399963 * static_cast<double>(i % 977));
      if (glm::dot(way, place.face) <= 0.0) continue;  // into the surface
      rays.push_back(
          rayFrom(place.position + gathering.offset * place.face, way, place.triangle, gathering.radius));
      owners.push_back(i);
    }
  }
  return rays;
}

glm::dvec3 wayOf(const device::Ray& ray) { return {ray.direction[0], ray.direction[1], ray.direction[2]}; }

/// Returns per place the mean over its rays of `valueOf`, which is 0 for rays that hit something; -1 without
/// a place.
template <typename Value, typename ValueOf>
std::vector<Value> meanOfOpen(std::span<const SeenPlace> places, const Gathering& gathering,
                              ValueOf valueOf) {
  std::vector<Value> result;
  for (const SeenPlace& place : places)
    result.push_back(Value(place.triangle == PRELIGHT_NO_TRIANGLE ? -1.0f : 0.0f));
  for (std::size_t first = 0; first < places.size(); first += pixelsAtOnce) {
    std::vector<std::size_t> owners;
    const std::vector<device::Ray> rays = raysFrom(places, first, gathering, owners);
    const std::vector<device::Hit> hits = gathering.tracer.traceAny(rays);
    for (std::size_t r = 0; r < hits.size(); ++r)
      if (hits[r].triangle == PRELIGHT_NO_TRIANGLE)
        result[owners[r]] += valueOf(wayOf(rays[r])) * (1.0f / static_cast<float>(gathering.rays));
  }
  return result;
}

/// Returns where a ray hits a surface, on the side that it comes from; no place at backs of one-sided
/// surfaces.
SeenPlace placeOfHit(const CompiledScene& scene, const device::Ray& ray, const device::Hit& hit) {
  SeenPlace place;
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return place;
  place.face = glm::normalize(geometricNormal(scene, hit.triangle));
  const bool isBack = glm::dot(place.face, wayOf(ray)) > 0.0;
  if (isBack && !scene.materials[scene.triangleMaterials[hit.triangle]].doubleSided) return place;
  if (isBack) place.face = -place.face;
  place.normal = place.face;
  place.position =
      glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]) + static_cast<double>(hit.t) * wayOf(ray);
  place.triangle = hit.triangle;
  return place;
}

std::vector<SeenPlace> placesOf(const CompiledScene& scene, Tracer& tracer,
                                const AccessibilityRequest& request) {
  return placesSeen(scene, tracer, {request.camera, request.width, request.height});
}

}  // namespace

std::vector<float> tracedAccessibility(const CompiledScene& scene, Tracer& tracer,
                                       const AccessibilityRequest& request) {
  return meanOfOpen<float>(placesOf(scene, tracer, request),
                           {tracer, seenOffset(scene), request.radius, request.rays},
                           [](const glm::dvec3&) { return 1.0f; });
}

std::vector<glm::vec3> tracedSkyLight(const CompiledScene& scene, Tracer& tracer,
                                      const AccessibilityRequest& request, const SkyFunction& sky) {
  return meanOfOpen<glm::vec3>(placesOf(scene, tracer, request),
                               {tracer, seenOffset(scene), request.radius, request.rays}, sky);
}

std::vector<glm::vec3> tracedBounce(const CompiledScene& scene, Tracer& tracer,
                                    const AccessibilityRequest& request, const SkyFunction& sky,
                                    int raysOfSenders) {
  const std::vector<SeenPlace> places = placesOf(scene, tracer, request);
  const Gathering gathering{tracer, seenOffset(scene), request.radius, request.rays};
  std::vector<glm::vec3> result;
  for (const SeenPlace& place : places)
    result.emplace_back(place.triangle == PRELIGHT_NO_TRIANGLE ? -1.0f : 0.0f);
  for (std::size_t first = 0; first < places.size(); first += pixelsAtOnce) {
    std::vector<std::size_t> owners;
    const std::vector<device::Ray> rays = raysFrom(places, first, gathering, owners);
    const std::vector<device::Hit> hits = tracer.traceClosest(rays);
    std::vector<SeenPlace> senders;
    for (std::size_t r = 0; r < hits.size(); ++r) senders.push_back(placeOfHit(scene, rays[r], hits[r]));
    const std::vector<glm::vec3> sent =
        meanOfOpen<glm::vec3>(senders, {tracer, gathering.offset, request.radius, raysOfSenders}, sky);
    for (std::size_t r = 0; r < hits.size(); ++r)
      result[owners[r]] += glm::max(sent[r], 0.0f) / static_cast<float>(request.rays);
  }
  return result;
}

double lightError(const std::vector<glm::vec3>& drawn, const std::vector<glm::vec3>& traced) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < traced.size(); ++i) {
    if (traced[i].r < 0.0f) continue;
    const glm::dvec3 difference(drawn[i] - traced[i]);
    sum += glm::dot(difference, difference);
    count += 3.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

double accessibilityError(const std::vector<float>& drawn, const std::vector<float>& traced) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < traced.size(); ++i) {
    if (traced[i] < 0.0f) continue;
    const double difference = double{drawn[i]} - traced[i];
    sum += difference * difference;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

Scene whitened(Scene scene) {
  for (Material& material : scene.materials) {
    Material white;
    white.name = material.name;
    white.metallic = white.specular = 0.0f;
    white.doubleSided = material.doubleSided;
    material = white;
  }
  for (Mesh& mesh : scene.meshes)
    for (Primitive& primitive : mesh.primitives) primitive.colors.clear();
  scene.lights.clear();
  return scene;
}

}  // namespace prelight::benchmarks
