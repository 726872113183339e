#pragma once

#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// The image plane of a camera, for the generation of its rays.
struct CameraAxes {
  glm::dvec3 eye{0.0};    ///< scene coordinates
  glm::dvec3 right{0.0};  ///< from the picture's centre to its right edge, at distance 1 (orthographic: m)
  glm::dvec3 up{0.0};     ///< from the picture's centre to its upper edge
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit
  bool perspective = true;
  /// M; distance at which rays start; 0 where nothing lies between the eye and the near plane.
  double zNear = 0.0;
};

/// Returns the axes of a camera for a picture of `aspect`, its width over its height.
CameraAxes cameraAxes(const Camera& camera, const CompiledScene& scene, double aspect);

}  // namespace prelight
