#pragma once

#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Slack about a scene's bounding sphere, so that what touches it is not cut by rounding.
constexpr double sphereSlack = 1.02;

/// A sphere around a scene's bounds; of radius 1 where these are empty or not finite.
struct BoundingSphere {
  glm::dvec3 centre{0.0};  ///< scene coordinates
  double radius = 1.0;
};

BoundingSphere boundingSphere(const CompiledScene& scene);

/// A camera for a scene that has none: three-quarter view from slightly above; the whole bounding sphere is
/// in the picture at every aspect >= 1, and near and far enclose it. Works for an empty scene, too.
Camera frameCamera(const CompiledScene& scene);

/// Width in pixels that fits the camera's aspect at a height; 16:9 when the camera leaves it to the picture.
int pictureWidth(const Camera& camera, int height);

}  // namespace prelight
