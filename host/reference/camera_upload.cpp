#include "reference/camera_upload.h"

#include <cmath>
#include <limits>

namespace prelight::reference {

namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

}  // namespace

void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& p) {
  const double aspect = static_cast<double>(width) / height;
  const double halfHeight = camera.perspective ? std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  store(p.eye, glm::dvec3(camera.world[3]) - scene.origin);
  store(p.right, halfHeight * aspect * glm::normalize(glm::dvec3(camera.world[0])));
  store(p.up, halfHeight * glm::normalize(glm::dvec3(camera.world[1])));
  store(p.forward, -glm::normalize(glm::dvec3(camera.world[2])));
  p.perspective = camera.perspective ? 1 : 0;
  p.zNear = static_cast<float>(camera.zNear);
  p.zFar = camera.zFar > 0.0 && camera.zFar < 1e30 ? static_cast<float>(camera.zFar)
                                                   : std::numeric_limits<float>::max();
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
}

}  // namespace prelight::reference
