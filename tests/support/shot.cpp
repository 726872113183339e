#include "support/shot.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/devices.h"

namespace prelight::test {

namespace {

glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 way = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(way.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  return glm::inverse(glm::lookAtRH(eye, target, up));
}

}  // namespace

reference::ReferenceInputs Shot::inputs() const {
  return {scene, images, lights, camera, sky ? &*sky : nullptr, 0.0};
}

reference::Film Shot::render() const {
  reference::Film film(request.width, request.height, request.parts);
  Progress progress;
  reference::ReferenceReport report;
  reference::renderReference(inputs(), request, sharedDevice(), progress, film, report);
  return film;
}

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double yFov) {
  Camera camera;
  camera.world = lookAt(eye, target);
  camera.yFov = yFov;
  camera.zNear = 1e-4;
  return camera;
}

Camera orthographicCamera(const glm::dvec3& eye, const glm::dvec3& target, double extent) {
  Camera camera = cameraAt(eye, target, 1.0);
  camera.perspective = false;
  camera.xMag = camera.yMag = extent;
  return camera;
}

Shot shotOf(CompiledScene scene, const Camera& camera, int size, std::uint64_t samples) {
  Shot shot;
  shot.scene = std::move(scene);
  shot.camera = camera;
  shot.request.width = shot.request.height = size;
  shot.request.samples = samples;
  return shot;
}

MeanAndError meanOf(const reference::Film& film) {
  const std::vector<float> variance = film.variance();
  MeanAndError result;
  for (std::size_t i = 0; i < film.pixelCount(); ++i) {
    result.mean += film.means[i];
    result.error += variance.empty() ? 0.0 : static_cast<double>(variance[i]);
  }
  const auto pixels = static_cast<double>(film.pixelCount());
  return {result.mean / pixels, std::sqrt(result.error) / pixels};
}

}  // namespace prelight::test
