#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::viewer {

/// A part of the scene that moves as one: a node's drawing of its mesh.
struct SceneObject {
  std::vector<std::size_t> primitives;  ///< into CompiledScene::primitives
};

/// In the order of their first primitives.
std::vector<SceneObject> objectsOf(const CompiledScene& scene);

/// Where the scene has the vertices of an object, primitive by primitive.
std::vector<glm::vec3> placesOf(const CompiledScene& scene, const SceneObject& object);

/// An object alone: the vertices of placesOf(), and of its triangles those that are neither blended nor
/// glass.
CompiledScene occluderOf(const CompiledScene& scene, const SceneObject& object);

}  // namespace prelight::viewer
