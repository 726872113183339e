#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "integrators/reference.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {

/// A scene with the other inputs of the reference renderer, and a way to render it.
struct Shot {
  CompiledScene scene;
  std::vector<Image> images;
  std::vector<Light> lights;
  std::optional<Environment> sky;
  Camera camera;
  reference::ReferenceRequest request;

  reference::ReferenceInputs inputs() const;
  reference::Film render() const;
};

/// A perspective camera.
Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double yFov);

/// An orthographic camera of half width and height `extent`.
Camera orthographicCamera(const glm::dvec3& eye, const glm::dvec3& target, double extent);

/// A shot of `scene` with a small square picture.
Shot shotOf(CompiledScene scene, const Camera& camera, int size, std::uint64_t samples);

/// Mean luminance of a film, and the standard error of that mean according to its passes.
struct MeanAndError {
  double mean = 0.0;
  double error = 0.0;
};
MeanAndError meanOf(const reference::Film& film);

}  // namespace prelight::test
