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

/// A camera that shows all vertices of a model as large as a picture of `aspect` (width / height) lets them
/// be, with a margin: a longer lens than frameCamera's, three-quarter view, from higher up where the model is
/// flat. Near and far enclose the scene. Works for an empty scene, too.
Camera frameModel(const CompiledScene& scene, double aspect);

/// Width in pixels that fits the camera's aspect at a height; 16:9 when the camera leaves it to the picture.
int pictureWidth(const Camera& camera, int height);

}  // namespace prelight
