#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Rest transform of a node to its parent.
glm::dmat4 localTransform(const SceneNode& node);

/// Moves a scene's mesh nodes, skins, cameras and lights to where an animation has them at a time (seconds;
/// before its first key and after its last it stands still), and sets morph weights and the properties that
/// it changes. What it does not animate rests. Meshes and images stay as they are, so that every pose
/// compiles to the same vertices in the same order. Throws UsageError for an animation that the scene lacks
/// and InputError when a transform is not finite.
void setPose(Scene& scene, std::size_t animation, double seconds);

/// What takes vertices to world space in a pose.
struct PosedTransforms {
  std::vector<std::vector<glm::dmat4>> nodes;   ///< [mesh node][instance]: MeshNode::transforms
  std::vector<std::vector<glm::dmat4>> joints;  ///< [skin][joint]: Skin::toWorld

  bool operator==(const PosedTransforms&) const = default;
};

/// Of the pose that the scene is in.
PosedTransforms transformsOf(const Scene& scene);

/// At a time, as setPose gives them. Throws as it does.
PosedTransforms transformsAt(const Scene& scene, std::size_t animation, double seconds);

/// A copy of a scene in a pose, see setPose.
Scene sceneAt(Scene scene, std::size_t animation, double seconds);

/// The animation that a number or a name means, into Scene::animations. Throws UsageError, listing those
/// that there are, when none or several are of that name.
std::size_t findAnimation(const Scene& scene, const std::string& nameOrIndex);

/// [mesh node] whether it, an ancestor, a joint of its skin or its morph weights are animated.
std::vector<bool> movedMeshNodes(const Scene& scene, const Animation& animation);

/// True when an animation moves a mesh node.
bool movesMeshes(const Scene& scene, const Animation& animation);

/// The same, or when what surfaces are made of changes: light transport does.
bool changesTransport(const Scene& scene, const Animation& animation);

/// Puts mesh nodes and skins where the scene's nodes are, `world` a matrix for each of Scene::nodes. Throws
/// InputError, its place with `prefix`, when a transform is not finite.
void placeMeshes(Scene& scene, std::span<const glm::dmat4> world, const std::string& prefix);

/// Puts a light where its node is. False when a scale of 0 leaves no direction; the world's axis is taken.
bool placeLight(Light& light, const glm::dmat4& world);
/// Puts a camera where its node is, without scale and shear. False as with placeLight.
bool placeCamera(Camera& camera, const glm::dmat4& world);

}  // namespace prelight
