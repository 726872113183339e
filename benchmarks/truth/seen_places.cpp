#include "benchmarks/truth/seen_places.h"

#include "benchmarks/run/measure.h"

#include <limits>
#include <optional>

#include "scene/camera.h"
#include "viewer/core/camera.h"

namespace prelight::benchmarks {
namespace {

constexpr int mostCulled = 64;  ///< backs of one-sided surfaces in front of what is seen

/// Returns the ray through the middle of a pixel that begins at a distance.
device::Ray rayOfPixel(const viewer::CameraMatrices& camera, const SeenView& view, int pixel, double from) {
  const double halfHeight = viewer::halfHeightOf(view.camera);
  const double x = (2.0 * (pixel % view.width) + 1.0) / view.width - 1.0;
  const double y = 1.0 - (2.0 * (pixel / view.width) + 1.0) / view.height;
  const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
  const glm::dvec3 across = halfHeight * (x * view.width / view.height * axes[0] + y * axes[1]);
  glm::dvec3 origin = camera.position, direction = camera.forward;
  (camera.perspective ? direction : origin) += across;
  direction = glm::normalize(direction);
  return rayFrom(origin + from * direction, direction, PRELIGHT_NO_TRIANGLE,
                 std::numeric_limits<float>::max());
}

glm::dvec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

/// Returns the place of a hit, or nothing for the back of a one-sided surface.
std::optional<SeenPlace> placeOf(const CompiledScene& scene, const device::Ray& ray, const device::Hit& hit) {
  SeenPlace place;
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

}  // namespace

double seenOffset(const CompiledScene& scene) { return 1e-6 * boundingSphere(scene).radius; }

std::vector<SeenPlace> placesSeen(const CompiledScene& scene, Tracer& tracer, const SeenView& view) {
  const viewer::CameraMatrices camera =
      viewer::cameraMatrices(view.camera, scene, static_cast<double>(view.width) / view.height);
  std::vector<SeenPlace> places(static_cast<std::size_t>(view.width) * view.height);
  std::vector<int> open(places.size());
  std::vector<double> from(places.size(), 0.0);
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<int>(i);
  for (int round = 0; round < mostCulled && !open.empty(); ++round) {
    std::vector<device::Ray> rays;
    for (const int pixel : open) rays.push_back(rayOfPixel(camera, view, pixel, from[pixel]));
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

}  // namespace prelight::benchmarks
