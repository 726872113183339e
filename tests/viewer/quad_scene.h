#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "viewer/render.h"

namespace prelight::test {

/// White, dielectric and without any specular reflection: the Lambertian surface of the closed forms.
Material lambertian(const glm::vec3& albedo);

/// A punctual light; `direction` need not be unit.
Light makeLight(LightType type, const glm::vec3& intensity, const glm::dvec3& position,
                const glm::dvec3& direction = {0, 0, -1});

/// Scenes of quads and what is drawn of them.
struct QuadScene {
  Scene scene;
  CompiledScene compiled;
  Bake bake;
  Environment environment;
  bool hasEnvironment = false;

  /// Appends the square [-half, half]^2 of the plane z = 0 that faces +Z, placed by `transform`; texture
  /// coordinates run from (0, 0) at its upper left. Returns its primitive, valid until the next call.
  Primitive& add(const Material& material, float half = 1.0f, const glm::dmat4& transform = glm::dmat4(1.0));

  /// Appends a camera; the first is used.
  void lookFrom(const glm::dvec3& eye, const glm::dvec3& target);

  void setSky(const Environment& sky);

  /// Compiles the scene; needed before everything below.
  void compile();

  /// Fills the bake: the same accessibility everywhere, and the transfer of open surfaces times `openness`.
  void bakeOpen(int order, int channels = 1, float accessibility = 1.0f, double openness = 1.0);

  viewer::RenderInputs inputs() const;
  Picture render(const viewer::RenderOptions& options) const;
};

/// Small square picture options.
viewer::RenderOptions square(viewer::Shading shading = viewer::Shading::Phong, int size = 33);

/// The pixel in the middle of a picture, or at a fraction of its size.
glm::vec3 pixelAt(const Picture& picture, double x = 0.5, double y = 0.5);

/// A sky of a colour a half space: +X red, -X green; both halves also 1 in blue above the horizon.
Environment halvedSky();

}  // namespace prelight::test
