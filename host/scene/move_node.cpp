#include "scene/move_node.h"

#include <glm/gtc/matrix_transform.hpp>

namespace prelight {

namespace {

/// Returns the point around which a node turns: its origin or, with a skin, the point to which its first
/// joint moves the mesh's origin.
glm::dvec3 originOf(const Scene& scene, const MeshNode& node, const glm::dmat4& transform) {
  if (node.skin < 0) return glm::dvec3(transform[3]);
  const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
  return glm::dvec3(transform * skin.toWorld[0][3]);
}

}  // namespace

void moveNode(const Scene& scene, MeshNode& node, const glm::dvec3& by, double turn) {
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0));
  for (glm::dmat4& transform : node.transforms) {
    const glm::dvec3 origin = originOf(scene, node, transform);
    transform = glm::translate(glm::dmat4(1.0), origin + by) * turned *
                glm::translate(glm::dmat4(1.0), -origin) * transform;
  }
}

}  // namespace prelight
