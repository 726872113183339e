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

/// Enlargement of a scene's bounding sphere, so that rounding does not cut what touches it.
constexpr double sphereSlack = 1.02;

/// A sphere around a scene's bounds; of radius 1 where these are empty or not finite.
struct BoundingSphere {
  glm::dvec3 centre{0.0};  ///< scene coordinates
  double radius = 1.0;
};

BoundingSphere boundingSphere(const CompiledScene& scene);

/// Returns a camera for a scene that has none: a three-quarter view from slightly above, with the whole
/// bounding sphere in the picture at every aspect >= 1 and between near and far. Works for an empty scene,
/// too.
Camera frameCamera(const CompiledScene& scene);

/// Returns a camera that shows all vertices of a model as large as a picture of `aspect` (width / height)
/// permits, with a margin: a longer lens than frameCamera's, three-quarter view, from higher up where the
/// model is flat. Near and far enclose the scene. Works for an empty scene, too.
Camera frameModel(const CompiledScene& scene, double aspect);

/// Returns the picture's width in pixels for the camera's aspect at a height; 16:9 when the camera has no
/// aspect.
int pictureWidth(const Camera& camera, int height);

}  // namespace prelight
