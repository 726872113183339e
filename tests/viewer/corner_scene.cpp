#include "viewer/corner_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "viewer/core/camera.h"

namespace prelight::test {

using std::numbers::pi;
using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;

viewer::RenderOptions screenOptions(int size, const ScreenOcclusionOptions& occlusion) {
  viewer::RenderOptions options = square(viewer::Shading::Screen, size);
  options.screenOcclusion = occlusion;
  options.samplesPerAxis = 1;
  return options;
}

ScreenOcclusionOptions within(double radius, OcclusionMethod method) {
  ScreenOcclusionOptions options;
  options.method = method;
  options.radius = radius;
  return options;
}

QuadScene cornerScene(const Material& wall, double scale, double half) {
  QuadScene corner;
  corner.add(lambertian(glm::vec3(1)), static_cast<float>(half * scale));
  corner.add(wall, static_cast<float>(half * scale),
             glm::rotate(glm::dmat4(1.0), -0.5 * pi, glm::dvec3(0, 1, 0)));
  corner.setSky(constantEnvironment(glm::vec3(1)));
  corner.lookFrom(scale * glm::dvec3(-1.2, -2.5, 1.8), scale * glm::dvec3(-0.3, 0, 0));
  corner.compile();
  return corner;
}

QuadScene smallCorner() { return cornerScene(lambertian(glm::vec3(1)), 1.0, 3.0); }

double openBeforeWall(double distance, double radius) {
  const double c = std::min(distance / radius, 1.0);
  return 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / pi;
}

glm::vec3 pixelOf(const Picture& picture, const QuadScene& quad, const glm::dvec3& point) {
  const viewer::CameraMatrices camera = viewer::cameraMatrices(
      quad.scene.cameras.front(), quad.compiled, static_cast<double>(picture.width) / picture.height);
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(point - quad.compiled.origin, 1.0);
  return pixelAt(picture, 0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
}

QuadScene cardOverFloor() {
  QuadScene scene;
  Material white = lambertian(glm::vec3(1));
  white.doubleSided = true;
  scene.add(white, 5.0f);
  scene.add(white, 0.3f, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 0.25)));
  scene.setSky(constantEnvironment(glm::vec3(1)));
  scene.lookFrom({0.2, -2.0, 2.0}, {0, 0, 0});
  scene.compile();
  return scene;
}

}  // namespace prelight::test
