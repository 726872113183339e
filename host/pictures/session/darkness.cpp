#include "pictures/session/darkness.h"

#include <algorithm>
#include <string>
#include <vector>

#include "scene/camera.h"
#include "scene/dark_lamps.h"
#include "scene/light_sources.h"
#include "scene/surface/surface_blocks.h"

namespace prelight::pictures {
namespace {

constexpr int sights = 24;  ///< rays along each side of the picture

bool seesSurface(const CompiledScene& scene, const Camera& camera, double aspect) {
  const CameraAxes axes = cameraAxes(camera, scene, aspect);
  const SurfaceBlocks blocks(scene, std::vector<std::uint8_t>(scene.primitives.size(), 1));
  for (int i = 0; i < sights * sights; ++i) {
    const double x = 2.0 * (i % sights + 0.5) / sights - 1.0, y = 2.0 * (i / sights + 0.5) / sights - 1.0;
    const glm::dvec3 across = x * axes.right + y * axes.up;
    if (blocks.firstMet(axes.perspective ? axes.eye : axes.eye + across,
                        axes.perspective ? axes.forward + across : axes.forward))
      return true;
  }
  return false;
}

}  // namespace

void warnOfDarkness(DrawingSession& session, const Picture& picture, const LoadedScene& loaded,
                    const Camera& camera, const PictureLight& light) {
  if (std::any_of(picture.pixels.begin(), picture.pixels.end(), shines)) {
    if (light.shutIn)
      for (const std::string& lamp : loaded.scene.sides.shutInLamps) session.warn(lamp);
    return;
  }
  const double aspect = static_cast<double>(picture.width) / picture.height;
  session.warn(seesSurface(loaded.compiled, camera, aspect)
                   ? darknessWarning("the picture", loaded.compiled, light.lights, light.sky)
                   : std::string("the picture is black all over, because the camera sees no surface"));
}

}  // namespace prelight::pictures
