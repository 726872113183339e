#include "integrators/camera_upload.h"

#include <limits>

#include "scene/camera_axes.h"

namespace prelight::reference {

namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

std::uint32_t foldSeed(std::uint64_t seed) {
  return static_cast<std::uint32_t>(seed) ^ (static_cast<std::uint32_t>(seed >> 32) * 0x9e3779b9u);
}

}  // namespace

void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& p) {
  const CameraAxes axes = cameraAxes(camera, scene, static_cast<double>(width) / height);
  store(p.eye, axes.eye);
  store(p.right, axes.right);
  store(p.up, axes.up);
  store(p.forward, axes.forward);
  p.perspective = axes.perspective ? 1 : 0;
  p.zNear = static_cast<float>(axes.zNear);
  p.zFar = camera.zFar > 0.0 && camera.zFar < 1e30 ? static_cast<float>(camera.zFar)
                                                   : std::numeric_limits<float>::max();
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
}

void setPathParameters(const ReferenceRequest& request, const TransportScene& scene,
                       device::ReferenceParameters& p) {
  p.samplesPerPass = samplesPerPass(request);
  p.seed = foldSeed(request.seed);
  p.rouletteDepth = static_cast<std::uint32_t>(request.rouletteDepth);
  p.mostSegments = static_cast<std::uint32_t>(request.depth);
  p.scene = scene.handle().layout();
}

}  // namespace prelight::reference
