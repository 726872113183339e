#include "integrators/lens.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "prelight/error.h"
#include "scene/camera.h"

namespace prelight::reference {

namespace {

struct Sight {
  glm::dvec3 from, along;  ///< scene coordinates; `along` is unit
  double nearest, farthest;
};

/// Returns the distance at which a line meets a triangle (Moeller and Trumbore 1997), or infinity.
double distanceTo(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Sight& sight) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const glm::dvec3 ab = b - a, ac = c - a, across = glm::cross(sight.along, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0.0) return infinite;
  const glm::dvec3 from = sight.from - a, beside = glm::cross(from, ab);
  const double u = glm::dot(from, across) / determinant;
  const double v = glm::dot(sight.along, beside) / determinant;
  const double t = glm::dot(ac, beside) / determinant;
  const bool meets = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= sight.nearest && t <= sight.farthest;
  return meets ? t : infinite;
}

}  // namespace

std::optional<double> depthInMiddle(const Camera& camera, const CompiledScene& scene) {
  const CameraAxes axes = cameraAxes(camera, scene, 1.0);
  Sight sight{axes.eye, axes.forward, axes.zNear, camera.zFar > 0.0 ? camera.zFar : infiniteFocus};
  std::optional<double> depth;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const glm::uvec3& corners = scene.triangles[i];
    const glm::dvec3 a(scene.positions[corners.x]), b(scene.positions[corners.y]),
        c(scene.positions[corners.z]);
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[i]];
    const bool back = glm::dot(glm::cross(b - a, c - a), sight.along) > 0.0;
    if (back && !material.doubleSided && !material.solid) continue;
    const double distance = distanceTo(a, b, c, sight);
    if (!std::isfinite(distance)) continue;
    sight.farthest = distance;
    depth = distance;
  }
  return depth;
}

Lens focused(const Lens& lens, const Camera& camera, const CompiledScene& scene) {
  if (lens.isPinhole()) return lens;
  if (lens.aperture <= 0.0 && !camera.perspective)
    throw UsageError(fmt::format("Lens::aperture f/{:g}", lens.fNumber),
                     "an orthographic camera has no focal length", "give the aperture in metres");
  Lens result = lens;
  const double focalLength = 0.5 * Lens::filmHeight / std::tan(0.5 * camera.yFov);
  if (lens.aperture <= 0.0) result.aperture = focalLength / lens.fNumber;
  if (!lens.focus) result.focus = depthInMiddle(camera, scene).value_or(infiniteFocus);
  return result;
}

}  // namespace prelight::reference
