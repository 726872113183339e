#pragma once

#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

/// Scenes whose light is known in closed form.
namespace prelight::benchmarks::stability {

using std::numbers::pi;

/// A Lambertian material.
Material matte(double albedo, double emission = 0.0);

/// The square [-half, half]^2 at y = 0, facing +Y, of `cells` x `cells` quads, moved by `offset`.
CompiledScene floorScene(double half, int cells, const Material& material,
                         const glm::dvec3& offset = glm::dvec3(0.0));

struct Sheet {
  double height = 0.0;
  Material material;
  bool facesDown = false;
};

/// Squares [-half, half]^2 over one another.
CompiledScene stackScene(double half, const std::vector<Sheet>& sheets);

/// A closed cube of `half` about `offset` that faces inwards, of `cells` x `cells` quads a face.
CompiledScene roomScene(double half, int cells, const Material& material,
                        const glm::dvec3& offset = glm::dvec3(0.0));

/// A closed sphere that faces inwards: 20 x 4^steps triangles.
CompiledScene hollowSphere(double radius, int steps, const Material& material);

Light pointLight(const glm::dvec3& position, double intensity);
Light farLight(const glm::dvec3& direction, double irradiance);

/// A camera at a place that looks at another.
Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double yFov);

/// For what asks for the images of a scene that has none.
const std::vector<Image>& noImages();

}  // namespace prelight::benchmarks::stability
