#include "viewer/techniques/screen/occlusion_band.h"

#include <algorithm>
#include <cmath>

#include "viewer/core/camera.h"

namespace prelight::viewer {
namespace {

constexpr double mostOfHeight = 0.5;      ///< of the picture's height
constexpr int mostPictureSamples = 1024;  ///< OpenGL draws pictures of 16384 at least

}  // namespace

double occlusionRadius(const ScreenOcclusionOptions& options, const CompiledScene& scene) {
  if (options.radius > 0.0) return options.radius;
  return occlusionRadiusShare * 2.0 * boundingSphere(scene).radius;
}

int occlusionMargin(const View& view, int samplesPerAxis, double radius, const CompiledScene& scene) {
  const double most =
      std::min(mostOfHeight * view.height, static_cast<double>(mostPictureSamples) / samplesPerAxis);
  double nearest = 1.0;
  if (view.camera.perspective) {
    const BoundingSphere sphere = boundingSphere(scene);
    const CameraMatrices camera = cameraMatrices(view.camera, scene, 1.0);
    nearest =
        std::max(glm::dot(sphere.centre - camera.position, camera.forward) - sphere.radius - radius, 0.0);
  }
  const double metres = nearest * 2.0 * halfHeightOf(view.camera) / view.height;  // a pixel
  const double wanted = radius / std::max(metres, 1e-30);
  return static_cast<int>(std::clamp(std::ceil(wanted), 1.0, std::max(most, 1.0)));
}

}  // namespace prelight::viewer
