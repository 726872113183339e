#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/camera.h"

namespace prelight::viewer {

/// Width over height of pictures of cameras that have no aspect.
constexpr double defaultAspect = 16.0 / 9.0;

/// Returns the camera `index` of the scene; without an index the first one, or, when the scene has none,
/// frameModel's for a picture of `aspect` (width / height). Throws UsageError when the index is out of range.
Camera chooseCamera(const Scene& scene, const CompiledScene& compiled, std::optional<int> index,
                    double aspect = defaultAspect);

/// Half of what a camera shows from bottom to top: metres on the plane at unit depth; of an orthographic one,
/// anywhere.
double halfHeightOf(const Camera& camera);

/// Camera matrices in the coordinates of a CompiledScene (world minus origin).
struct CameraMatrices {
  glm::dmat4 view{1.0};        ///< scene to camera
  glm::dmat4 projection{1.0};  ///< camera to clip space, depth -1..1
  glm::dvec3 position{0.0};    ///< scene coordinates
  glm::dvec3 forward{0.0, 0.0, -1.0};
  bool perspective = true;
};

/// Matrices for a picture of `aspect` (width / height; keeps the vertical field). Near and far are tightened
/// to the scene's bounds, which clips nothing that the camera does not clip and keeps the depth buffer
/// precise.
CameraMatrices cameraMatrices(const Camera& camera, const CompiledScene& scene, double aspect);

}  // namespace prelight::viewer
