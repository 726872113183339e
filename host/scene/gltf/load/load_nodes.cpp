#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/load_parts.h"
#include "scene/pose.h"

namespace prelight {

namespace {

glm::dquat unitRotation(const LoadContext& context, const std::string& path, const glm::dvec4& xyzw) {
  const double length = glm::length(xyzw);
  if (!(length > 0.0) || !std::isfinite(length)) {
    context.warn(path, "a rotation of length 0 is taken as none");
    return {1.0, 0.0, 0.0, 0.0};
  }
  const glm::dvec4 q = xyzw / length;
  return {q.w, q.x, q.y, q.z};
}

glm::dmat4 matrixOf(const LoadContext& context, const std::string& path, const std::vector<double>& numbers) {
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
  if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
    context.warn(path + "/matrix", "the last row is not 0 0 0 1; it is taken as such");
    matrix[0][3] = matrix[1][3] = matrix[2][3] = 0.0;
    matrix[3][3] = 1.0;
  }
  return matrix;
}

SceneNode loadNode(const LoadContext& context, int index, int parent) {
  const tinygltf::Node& source = context.model.nodes[static_cast<std::size_t>(index)];
  const std::string path = fmt::format("/nodes/{}", index);
  SceneNode node;
  node.node = index;
  node.parent = parent;
  if (source.matrix.size() == 16) {
    node.hasMatrix = true;
    node.matrix = matrixOf(context, path, source.matrix);
    return node;
  }
  if (source.translation.size() == 3)
    node.translation = {source.translation[0], source.translation[1], source.translation[2]};
  if (source.scale.size() == 3) node.scale = {source.scale[0], source.scale[1], source.scale[2]};
  if (source.rotation.size() == 4) {
    const std::vector<double>& r = source.rotation;
    node.rotation = unitRotation(context, path + "/rotation", {r[0], r[1], r[2], r[3]});
  }
  return node;
}

bool hasFiniteEntries(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

/// Returns the roots of the file's default scene, else of its first; without scenes all nodes that are not
/// children.
std::vector<int> rootNodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  }
  std::vector<bool> isChild(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!isChild[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// Returns the floats of an instancing attribute; empty when the file does not have it.
std::vector<float> instanceAttribute(const LoadContext& context, const JsonCursor& attributes,
                                     const char* name) {
  const auto attribute = attributes.find(name);
  if (!attribute) return {};
  const AccessorReader reader(context.document, attribute->asUnsigned());
  return reader.floats(reader.componentType() != 5126);
}

}  // namespace

std::vector<SceneNode> loadNodes(const LoadContext& context) {
  const std::vector<int> roots = rootNodes(context.model);
  struct Pending {
    int node;
    int parent;
  };
  // An explicit stack is used instead of recursion, because a file may chain any number of nodes.
  std::vector<Pending> pending;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, -1});
  std::vector<SceneNode> nodes;
  while (!pending.empty()) {
    const auto [node, parent] = pending.back();
    pending.pop_back();
    const auto place = static_cast<int>(nodes.size());
    nodes.push_back(loadNode(context, node, parent));
    const std::vector<int>& children = context.model.nodes[static_cast<std::size_t>(node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      pending.push_back({*child, place});
  }
  return nodes;
}

std::vector<glm::dmat4> restTransforms(const LoadContext& context, const std::vector<SceneNode>& nodes) {
  std::vector<glm::dmat4> world;
  world.reserve(nodes.size());
  for (const SceneNode& node : nodes) {
    const glm::dmat4 local = localTransform(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local);
    if (!hasFiniteEntries(world.back())) {
      throw InputError(context.where(fmt::format("/nodes/{}", node.node)),
                       "the transform to world space is not finite", "check the scales of its ancestors");
    }
  }
  return world;
}

std::vector<glm::dmat4> loadInstances(const LoadContext& context, int node) {
  const JsonCursor json = context.root.at("nodes").at(static_cast<std::size_t>(node));
  const auto instancing = LoadContext::extension(json, "EXT_mesh_gpu_instancing");
  if (!instancing) return {};
  const JsonCursor attributes = instancing->at("attributes");
  const std::vector<float> translations = instanceAttribute(context, attributes, "TRANSLATION");
  const std::vector<float> rotations = instanceAttribute(context, attributes, "ROTATION");
  const std::vector<float> scales = instanceAttribute(context, attributes, "SCALE");
  const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
  const std::string path = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node);
  if (count == 0) {
    context.warn(path, "no TRANSLATION, ROTATION or SCALE; the mesh is drawn once");
    return {};
  }
  std::vector<glm::dmat4> transforms;
  transforms.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 translation(0.0);
    glm::dvec3 scale(1.0);
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (!translations.empty())
      translation = {translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]};
    if (!scales.empty()) scale = {scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
    if (!rotations.empty()) {
      const float* r = &rotations[4 * i];
      rotation = unitRotation(context, path, {r[0], r[1], r[2], r[3]});
    }
    transforms.push_back(
        localTransform(SceneNode{0, -1, false, glm::dmat4(1.0), translation, rotation, scale}));
  }
  return transforms;
}

}  // namespace prelight
