#include "scene/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "prelight/error.h"
#include "scene/animation.h"

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

namespace {

/// Normalises a direction; returns false for 0. Divides by the largest component first, because the squares
/// of tiny scales would vanish.
bool normalise(glm::dvec3& direction) {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0.0)) return false;
  direction = glm::normalize(direction / largest);
  return true;
}

bool isFinite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row])) return false;
  return true;
}

void animate(SceneNode& node, AnimatedPath path, const glm::dvec4& value) {
  switch (path) {
    case AnimatedPath::Translation:
      node.translation = glm::dvec3(value);
      break;
    case AnimatedPath::Rotation:
      node.rotation = {value.w, value.x, value.y, value.z};
      break;
    case AnimatedPath::Scale:
      node.scale = glm::dvec3(value);
      break;
    case AnimatedPath::Weights:
      break;
  }
}

std::string animationList(const Scene& scene) {
  if (scene.animations.empty()) return "the scene has no animations";
  std::string list;
  for (std::size_t i = 0; i < scene.animations.size(); ++i)
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.animations[i].name);
  return "the scene has " + list;
}

std::string placeOf(std::size_t animation, double seconds) {
  return fmt::format("animation {} at {} s: ", animation, seconds);
}

const Animation& animationOf(const Scene& scene, std::size_t animation) {
  if (animation < scene.animations.size()) return scene.animations[animation];
  throw UsageError(fmt::format("animation {}", animation), "there is none", animationList(scene));
}

/// Returns a matrix for each of Scene::nodes.
std::vector<glm::dmat4> worldAt(const Scene& scene, const Animation& played, double seconds) {
  std::vector<SceneNode> nodes = scene.nodes;
  for (const AnimationChannel& channel : played.channels)
    if (channel.path != AnimatedPath::Weights)
      animate(nodes[channel.node], channel.path,
              sampleAt(played.samplers[channel.sampler], channel.path, seconds));
  std::vector<glm::dmat4> world;
  world.reserve(nodes.size());
  for (const SceneNode& node : nodes) {
    const glm::dmat4 local = localTransform(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local);
  }
  return world;
}

/// Returns the transforms of a node's instances.
std::vector<glm::dmat4> transformsOf(const MeshNode& node, std::span<const glm::dmat4> world,
                                     const std::string& prefix) {
  const glm::dmat4 own = node.skin >= 0 ? glm::dmat4(1.0) : world[node.sceneNode];
  std::vector<glm::dmat4> transforms;
  if (node.instances.empty()) transforms.push_back(own);
  for (const glm::dmat4& instance : node.instances) transforms.push_back(own * instance);
  const auto bad = std::find_if_not(transforms.begin(), transforms.end(), isFinite);
  if (bad == transforms.end()) return transforms;
  const std::string instanced = node.instances.empty() ? "" : "/extensions/EXT_mesh_gpu_instancing";
  throw InputError(fmt::format("{}/nodes/{}{}", prefix, node.node, instanced),
                   fmt::format("the transform of instance {} is not finite", bad - transforms.begin()),
                   "check the scales of the node and its ancestors");
}

/// Returns the matrices from a mesh to world space, one per joint of a skin.
std::vector<glm::dmat4> jointsToWorld(const Scene& scene, const Skin& skin, std::span<const glm::dmat4> world,
                                      const std::string& prefix) {
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    matrices.push_back(world[skin.joints[j]] * skin.inverseBind[j]);
    if (!isFinite(matrices.back()))
      throw InputError(fmt::format("{}/nodes/{}", prefix, scene.nodes[skin.joints[j]].node),
                       fmt::format("as joint {} of a skin its transform is not finite", j),
                       "check the scales of the node and its ancestors, and the inverse bind matrix");
  }
  return matrices;
}

/// Sets the morph weights of mesh nodes that an animation changes; others keep their rest weights.
void setWeights(Scene& scene, const Animation& played, double seconds) {
  std::map<std::size_t, const AnimationSampler*> samplers;  // by node of the scene
  for (const AnimationChannel& channel : played.channels)
    if (channel.path == AnimatedPath::Weights) samplers[channel.node] = &played.samplers[channel.sampler];
  for (MeshNode& node : scene.meshNodes) {
    const auto sampler = samplers.find(node.sceneNode);
    node.weights = sampler == samplers.end() ? node.restWeights : weightsAt(*sampler->second, seconds);
  }
}

/// Returns [node of the scene] whether an animation moves it.
std::vector<bool> movedNodes(const Scene& scene, const Animation& animation) {
  std::vector<bool> moves(scene.nodes.size(), false);
  for (const AnimationChannel& channel : animation.channels)
    if (channel.path != AnimatedPath::Weights) moves[channel.node] = true;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (parent >= 0 && moves[static_cast<std::size_t>(parent)]) moves[i] = true;
  }
  return moves;
}

}  // namespace

glm::dmat4 localTransform(const SceneNode& node) {
  if (node.hasMatrix) return node.matrix;
  return glm::scale(glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation),
                    node.scale);
}

bool placeLight(Light& light, const glm::dmat4& world) {
  light.position = glm::dvec3(world[3]);
  if (light.type == LightType::Point && light.profile == nullptr) return true;
  light.direction = -glm::dvec3(world[2]);
  const bool directed = normalise(light.direction);
  if (!directed) light.direction = {0.0, 0.0, -1.0};
  if (light.profile == nullptr) return directed;
  light.side = glm::dvec3(world[0]);
  bool sided = normalise(light.side);
  light.side -= glm::dot(light.side, light.direction) * light.direction;
  // Shear may make the side parallel to the light's direction; any perpendicular is used then.
  if (!sided || glm::length(light.side) < 1e-9) {
    sided = false;
    const glm::dvec3 other = std::abs(light.direction.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    light.side = other - glm::dot(other, light.direction) * light.direction;
  }
  light.side = glm::normalize(light.side);
  return directed && sided;
}

bool placeCamera(Camera& camera, const glm::dmat4& world) {
  glm::dvec3 back(world[2]), up(world[1]);
  const bool hasBack = normalise(back), hasUp = normalise(up);
  if (!hasBack) back = {0.0, 0.0, 1.0};
  if (!hasUp) up = {0.0, 1.0, 0.0};
  glm::dvec3 right = glm::cross(up, back);
  // Shear may make up parallel to the view direction; any perpendicular is used then.
  if (glm::length(right) < 1e-9)
    right = glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), back);
  right = glm::normalize(right);
  camera.world = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0),
                  glm::dvec4(glm::dvec3(world[3]), 1.0)};
  return hasBack && hasUp;
}

void placeMeshes(Scene& scene, std::span<const glm::dmat4> world, const std::string& prefix) {
  for (Skin& skin : scene.skins) skin.toWorld = jointsToWorld(scene, skin, world, prefix);
  for (MeshNode& node : scene.meshNodes) node.transforms = transformsOf(node, world, prefix);
}

PosedTransforms transformsOf(const Scene& scene) {
  PosedTransforms transforms;
  for (const MeshNode& node : scene.meshNodes) transforms.nodes.push_back(node.transforms);
  for (const Skin& skin : scene.skins) transforms.joints.push_back(skin.toWorld);
  return transforms;
}

PosedTransforms transformsAt(const Scene& scene, std::size_t animation, double seconds) {
  const std::vector<glm::dmat4> world = worldAt(scene, animationOf(scene, animation), seconds);
  const std::string prefix = placeOf(animation, seconds);
  PosedTransforms transforms;
  for (const MeshNode& node : scene.meshNodes) transforms.nodes.push_back(transformsOf(node, world, prefix));
  for (const Skin& skin : scene.skins) transforms.joints.push_back(jointsToWorld(scene, skin, world, prefix));
  return transforms;
}

void setPose(Scene& scene, std::size_t animation, double seconds) {
  const Animation& played = animationOf(scene, animation);
  const std::vector<glm::dmat4> world = worldAt(scene, played, seconds);
  setWeights(scene, played, seconds);
  placeMeshes(scene, world, placeOf(animation, seconds));
  for (Camera& camera : scene.cameras)
    if (camera.sceneNode < world.size()) placeCamera(camera, world[camera.sceneNode]);
  for (Light& light : scene.lights) placeLight(light, world[light.sceneNode]);
  setProperties(scene, played, seconds);
  scene.moment = {animation, seconds};
}

Scene sceneAt(Scene scene, std::size_t animation, double seconds) {
  setPose(scene, animation, seconds);
  return scene;
}

std::size_t findAnimation(const Scene& scene, const std::string& nameOrIndex) {
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < scene.animations.size(); ++i)
    if (scene.animations[i].name == nameOrIndex) named.push_back(i);
  if (named.size() == 1) return named.front();
  if (named.size() > 1)
    throw UsageError("animation " + nameOrIndex, fmt::format("{} have that name", named.size()),
                     "give its number: " + animationList(scene));
  std::size_t index = 0;
  const char* end = nameOrIndex.data() + nameOrIndex.size();
  const auto [stop, error] = std::from_chars(nameOrIndex.data(), end, index);
  if (error != std::errc{} || stop != end || index >= scene.animations.size())
    throw UsageError("animation " + nameOrIndex, "there is none with that name or number",
                     animationList(scene));
  return index;
}

namespace {

/// How an animation changes a mesh node.
struct NodeChange {
  bool moves = false;  ///< rigidly, or scaled
  bool bends = false;  ///< by its skin or by morph targets
};

std::vector<NodeChange> changesOf(const Scene& scene, const Animation& animation) {
  const std::vector<bool> moves = movedNodes(scene, animation);
  const auto movesSkin = [&](int skin) {
    const std::vector<std::size_t>& joints = scene.skins[static_cast<std::size_t>(skin)].joints;
    return std::any_of(joints.begin(), joints.end(), [&](std::size_t joint) { return moves[joint]; });
  };
  std::vector<bool> morphs(scene.nodes.size(), false);
  for (const AnimationChannel& channel : animation.channels)
    if (channel.path == AnimatedPath::Weights) morphs[channel.node] = true;
  std::vector<NodeChange> changes;
  for (const MeshNode& node : scene.meshNodes)
    changes.push_back({node.skin < 0 && moves[node.sceneNode],
                       (node.skin >= 0 && movesSkin(node.skin)) || morphs[node.sceneNode]});
  return changes;
}

}  // namespace

std::vector<bool> movedMeshNodes(const Scene& scene, const Animation& animation) {
  std::vector<bool> moved;
  for (const NodeChange& change : changesOf(scene, animation)) moved.push_back(change.moves || change.bends);
  return moved;
}

bool bendsMeshes(const Scene& scene, const Animation& animation) {
  const std::vector<NodeChange> changes = changesOf(scene, animation);
  return std::any_of(changes.begin(), changes.end(), [](const NodeChange& change) { return change.bends; });
}

bool movesMeshes(const Scene& scene, const Animation& animation) {
  const std::vector<bool> moved = movedMeshNodes(scene, animation);
  return std::find(moved.begin(), moved.end(), true) != moved.end();
}

bool changesTransport(const Scene& scene, const Animation& animation) {
  return movesMeshes(scene, animation) || changesSurfaces(animation);
}

}  // namespace prelight
