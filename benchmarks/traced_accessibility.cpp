#include "benchmarks/traced_accessibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/seen_places.h"

namespace prelight::benchmarks {
namespace {

constexpr double goldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);
constexpr std::size_t pixelsAtOnce = 4096;

/// Direction `index` of `count`, of cosine density about z: a spiral, turned.
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

}  // namespace

std::vector<float> tracedAccessibility(const CompiledScene& scene, Tracer& tracer,
                                       const AccessibilityRequest& request) {
  const std::vector<SeenPlace> places =
      placesSeen(scene, tracer, {request.camera, request.width, request.height});
  const double offset = seenOffset(scene);
  std::vector<float> result(places.size(), -1.0f);
  for (std::size_t first = 0; first < places.size(); first += pixelsAtOnce) {
    std::vector<device::Ray> rays;
    std::vector<std::size_t> pixels;
    const std::size_t last = std::min(first + pixelsAtOnce, places.size());
    for (std::size_t i = first; i < last; ++i) {
      const SeenPlace& place = places[i];
      if (place.triangle == PRELIGHT_NO_TRIANGLE) continue;
      const glm::dmat3 frame = frameAbout(place.normal);
      result[i] = 0.0f;
      for (int k = 0; k < request.rays; ++k) {
        const glm::dvec3 way = frame * spiral(k, request.rays, 2.399963 * static_cast<double>(i % 977));
        if (glm::dot(way, place.face) <= 0.0) continue;  // into the surface
        rays.push_back(rayFrom(place.position + offset * place.face, way, place.triangle, request.radius));
        pixels.push_back(i);
      }
    }
    const std::vector<device::Hit> hits = tracer.traceAny(rays);
    for (std::size_t r = 0; r < hits.size(); ++r)
      if (hits[r].triangle == PRELIGHT_NO_TRIANGLE)
        result[pixels[r]] += 1.0f / static_cast<float>(request.rays);
  }
  return result;
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
