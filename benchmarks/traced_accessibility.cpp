#include "benchmarks/traced_accessibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "scene/framing.h"
#include "viewer/camera.h"

namespace prelight::benchmarks {
namespace {

constexpr double goldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);
constexpr int mostCulled = 64;  ///< backs of one-sided surfaces in front of what is seen
constexpr std::size_t pixelsAtOnce = 4096;
constexpr double offsetShare = 1e-6;  ///< of the scene's radius, that rays begin above the surface

struct Place {
  glm::dvec3 position{0.0};
  glm::dvec3 face{0.0}, normal{0.0};  ///< unit, on the side seen: of the triangle, and that it is shaded with
  std::uint32_t triangle = PRELIGHT_NO_TRIANGLE;
};

device::Ray rayFrom(const glm::dvec3& from, const glm::dvec3& to, std::uint32_t triangle, double farthest) {
  return {{static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z)},
          triangle,
          {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)},
          static_cast<float>(farthest)};
}

/// Through the middle of a pixel, on from a distance.
device::Ray rayOfPixel(const viewer::CameraMatrices& camera, const AccessibilityRequest& request, int pixel,
                       double from) {
  const double halfHeight = viewer::halfHeightOf(request.camera);
  const double x = (2.0 * (pixel % request.width) + 1.0) / request.width - 1.0;
  const double y = 1.0 - (2.0 * (pixel / request.width) + 1.0) / request.height;
  const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
  const glm::dvec3 across = halfHeight * (x * request.width / request.height * axes[0] + y * axes[1]);
  glm::dvec3 origin = camera.position, direction = camera.forward;
  (camera.perspective ? direction : origin) += across;
  direction = glm::normalize(direction);
  return rayFrom(origin + from * direction, direction, PRELIGHT_NO_TRIANGLE,
                 std::numeric_limits<float>::max());
}

glm::dvec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

/// What a hit is seen as; nothing where it is the back of a one-sided surface.
std::optional<Place> placeOf(const CompiledScene& scene, const device::Ray& ray, const device::Hit& hit) {
  Place place;
  place.triangle = hit.triangle;
  place.face = glm::normalize(geometricNormal(scene, hit.triangle));
  const double side = glm::dot(place.face, vec(ray.direction)) < 0.0 ? 1.0 : -1.0;
  if (side < 0.0 && !scene.materials[scene.triangleMaterials[hit.triangle]].doubleSided) return std::nullopt;
  const glm::uvec3& corners = scene.triangles[hit.triangle];
  const glm::dvec3 weights(1.0 - hit.u - hit.v, hit.u, hit.v);
  glm::dvec3 normal(0.0);
  for (int i = 0; i < 3; ++i) {
    place.position += weights[i] * glm::dvec3(scene.positions[corners[i]]);
    normal += weights[i] * glm::dvec3(scene.normals[corners[i]]);
  }
  const bool isFlat = scene.triangleFlat[hit.triangle] != 0 || glm::length(normal) < 1e-6;
  place.normal = side * (isFlat ? place.face : glm::normalize(normal));
  place.face *= side;
  return place;
}

/// [pixel]; without a triangle where nothing is seen.
std::vector<Place> placesSeen(const CompiledScene& scene, Tracer& tracer,
                              const AccessibilityRequest& request) {
  const viewer::CameraMatrices camera =
      viewer::cameraMatrices(request.camera, scene, static_cast<double>(request.width) / request.height);
  std::vector<Place> places(static_cast<std::size_t>(request.width) * request.height);
  std::vector<int> open(places.size());
  std::vector<double> from(places.size(), 0.0);
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<int>(i);
  for (int round = 0; round < mostCulled && !open.empty(); ++round) {
    std::vector<device::Ray> rays;
    for (const int pixel : open) rays.push_back(rayOfPixel(camera, request, pixel, from[pixel]));
    const std::vector<device::Hit> hits = tracer.traceClosest(rays);
    std::vector<int> left;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
      if (const auto place = placeOf(scene, rays[i], hits[i])) {
        places[open[i]] = *place;
      } else {
        from[open[i]] += hits[i].t * (1.0 + 1e-5);
        left.push_back(open[i]);
      }
    }
    open = std::move(left);
  }
  return places;
}

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
  const std::vector<Place> places = placesSeen(scene, tracer, request);
  const double offset = offsetShare * boundingSphere(scene).radius;
  std::vector<float> result(places.size(), -1.0f);
  for (std::size_t first = 0; first < places.size(); first += pixelsAtOnce) {
    std::vector<device::Ray> rays;
    std::vector<std::size_t> pixels;
    const std::size_t last = std::min(first + pixelsAtOnce, places.size());
    for (std::size_t i = first; i < last; ++i) {
      const Place& place = places[i];
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
