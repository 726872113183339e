#include "support/instanced_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include "support/scenes.h"

namespace prelight::test {

glm::dmat4 placedAtRandom(std::mt19937& random, double half) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const glm::dvec3 place(half * unit(random), half * unit(random), half * unit(random));
  const double angle = 3.0 * unit(random);
  return glm::rotate(glm::translate(glm::dmat4(1.0), place), angle, glm::dvec3(randomDirection(random)));
}

Mesh meshOf(const CompiledScene& shape) {
  Primitive primitive;
  primitive.positions = shape.positions;
  primitive.normals = shape.normals;
  primitive.triangles = shape.triangles;
  return {"mesh", {primitive}};
}

Scene strewnScene(std::size_t drawings, double half, std::uint32_t seed) {
  std::mt19937 random(seed);
  Scene scene;
  scene.meshes = {meshOf(sphere(12, 1.0f, {0.5f, 0, 0})),
                  meshOf(box(4, {-1, -0.5f, -1}, {1, 0.5f, 1}, false)),
                  meshOf(ground(2, static_cast<float>(half), static_cast<float>(-half))),
                  meshOf(box(2, {-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}, false))};
  const auto draw = [&](int mesh, const glm::dmat4& transform) {
    const auto node = static_cast<int>(scene.nodes.size());
    SceneNode place;
    place.node = node;
    place.hasMatrix = true;
    place.matrix = transform;
    scene.nodes.push_back(place);
    scene.meshNodes.push_back({node, "drawing", mesh, {transform}, static_cast<std::size_t>(node)});
  };
  for (std::size_t i = 0; i < drawings; ++i) {
    glm::dmat4 transform = placedAtRandom(random, half);
    if (i % 5 == 1) transform = glm::scale(transform, glm::dvec3(0.4));
    if (i % 7 == 3) transform = glm::scale(transform, glm::dvec3(-1.0, 0.7, 1.3));
    draw(static_cast<int>(i % 2), transform);
    if (i == drawings / 2) draw(3, placedAtRandom(random, half));
  }
  draw(2, glm::dmat4(1.0));
  return scene;
}

CompiledScene compiled(const Scene& scene) {
  Warnings warnings;
  return compileScene(scene, warnings);
}

}  // namespace prelight::test
