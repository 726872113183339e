#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "viewer/frame/render.h"

namespace prelight::test {

/// A white dielectric without specular reflection: the Lambertian surface of the closed forms.
Material lambertian(const glm::vec3& albedo);

/// A punctual light; `direction` need not have unit length.
Light makeLight(LightType type, const glm::vec3& intensity, const glm::dvec3& position,
                const glm::dvec3& direction = {0, 0, -1});

/// Scenes of quads, and pictures of them.
struct QuadScene {
  Scene scene;
  CompiledScene compiled;
  Bake bake;
  Environment environment;
  bool hasEnvironment = false;

  /// Appends the square [-half, half]^2 of the plane z = 0 that faces +Z, placed by `transform`. Texture
  /// coordinates start with (0, 0) at its upper left. Returns its primitive, which is valid until the next
  /// call.
  Primitive& add(const Material& material, float half = 1.0f, const glm::dmat4& transform = glm::dmat4(1.0));

  /// Appends a camera; pictures use the first one.
  void lookFrom(const glm::dvec3& eye, const glm::dvec3& target);

  void setSky(const Environment& sky);

  /// Compiles the scene, as everything below requires.
  void compile();

  /// Fills the bake with the same accessibility everywhere, and with the transfer of open surfaces times
  /// `openness`.
  void bakeOpen(int order, int channels = 1, float accessibility = 1.0f, double openness = 1.0);

  viewer::RenderInputs inputs() const;
  Picture render(const viewer::RenderOptions& options) const;
};

/// Options of a small square picture.
viewer::RenderOptions square(viewer::Shading shading = viewer::Shading::Phong, int size = 33);

/// The same, of a picture in which lamps have no shadows but those of the shading's own data.
viewer::RenderOptions squareByBake(viewer::Shading shading, int size = 33);

/// The pixel in the middle of a picture, or at a fraction of its size.
glm::vec3 pixelAt(const Picture& picture, double x = 0.5, double y = 0.5);

/// A sky with one colour per half space: +X is red, -X green; both halves also have 1 in blue above the
/// horizon.
Environment halvedSky();

}  // namespace prelight::test
