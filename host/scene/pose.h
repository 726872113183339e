#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Turns a node of a posed scene, with its mesh, around the vertical through its origin by `turn` (radians,
/// counter-clockwise seen from above), then moves it by `by` (m, world space). Its child nodes stay in place.
void moveNode(const Scene& scene, MeshNode& node, const glm::dvec3& by, double turn);

/// Returns the rest transform of a node to its parent.
glm::dmat4 localTransform(const SceneNode& node);

/// Moves a scene's mesh nodes, skins, cameras and lights to their poses at a time of an animation (seconds;
/// before its first and after its last key the pose is constant), and sets morph weights and animated
/// properties. Everything else is at rest. Meshes and images are unchanged, so that every pose compiles to
/// the same vertices in the same order. Throws UsageError for an animation that the scene lacks and
/// InputError when a transform is not finite.
void setPose(Scene& scene, std::size_t animation, double seconds);

/// The transforms of vertices to world space in a pose.
struct PosedTransforms {
  std::vector<std::vector<glm::dmat4>> nodes;   ///< [mesh node][instance]: MeshNode::transforms
  std::vector<std::vector<glm::dmat4>> joints;  ///< [skin][joint]: Skin::toWorld

  bool operator==(const PosedTransforms&) const = default;
};

/// Returns the transforms of the scene's current pose.
PosedTransforms transformsOf(const Scene& scene);

/// Returns the transforms at a time, as setPose sets them. Throws as setPose does.
PosedTransforms transformsAt(const Scene& scene, std::size_t animation, double seconds);

/// Returns a copy of a scene in a pose, see setPose.
Scene sceneAt(Scene scene, std::size_t animation, double seconds);

/// Returns the index in Scene::animations for a number or a name. Throws UsageError, listing the animations,
/// when none or several have that name.
std::size_t findAnimation(const Scene& scene, const std::string& nameOrIndex);

/// Returns [mesh node] whether it, an ancestor, a joint of its skin or its morph weights are animated.
std::vector<bool> movedMeshNodes(const Scene& scene, const Animation& animation);

/// Returns true when an animation changes the shape of a mesh by a skin or by morph targets.
bool bendsMeshes(const Scene& scene, const Animation& animation);

/// Returns true when an animation moves a mesh node.
bool movesMeshes(const Scene& scene, const Animation& animation);

/// Returns true when an animation moves a mesh node or changes materials of surfaces, and with them light
/// transport.
bool changesTransport(const Scene& scene, const Animation& animation);

/// Places mesh nodes and skins by `world`, a matrix for each of Scene::nodes. Throws InputError, whose place
/// begins with `prefix`, when a transform is not finite.
void placeMeshes(Scene& scene, std::span<const glm::dmat4> world, const std::string& prefix);

/// Places a light at its node. Returns false when a scale of 0 leaves no direction; the world's axis is used
/// then.
bool placeLight(Light& light, const glm::dmat4& world);
/// Places a camera at its node, without scale and shear. Returns false as placeLight does.
bool placeCamera(Camera& camera, const glm::dmat4& world);

}  // namespace prelight
