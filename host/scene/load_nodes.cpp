#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "scene/accessor.h"
#include "scene/load_parts.h"

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

glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dquat& rotation,
                            const glm::dvec3& scale) {
  return glm::scale(glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation), scale);
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

glm::dmat4 localTransform(const LoadContext& context, int index) {
  const tinygltf::Node& node = context.model.nodes[static_cast<std::size_t>(index)];
  const std::string path = fmt::format("/nodes/{}", index);
  if (node.matrix.size() == 16) return matrixOf(context, path, node.matrix);
  glm::dvec3 translation(0.0);
  glm::dvec3 scale(1.0);
  glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
  if (node.translation.size() == 3)
    translation = {node.translation[0], node.translation[1], node.translation[2]};
  if (node.scale.size() == 3) scale = {node.scale[0], node.scale[1], node.scale[2]};
  if (node.rotation.size() == 4) {
    const std::vector<double>& r = node.rotation;
    rotation = unitRotation(context, path + "/rotation", {r[0], r[1], r[2], r[3]});
  }
  return composeTransform(translation, rotation, scale);
}

bool isFinite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

/// Scene = the file's default, else its first; without scenes every node that is no child.
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

/// Floats of an instancing attribute; empty when the file does not give it.
std::vector<float> instanceAttribute(const LoadContext& context, const JsonCursor& attributes,
                                     const char* name) {
  const auto attribute = attributes.find(name);
  if (!attribute) return {};
  const AccessorReader reader(context.document, attribute->asUnsigned());
  return reader.floats(reader.componentType() != 5126);
}

}  // namespace

std::vector<WorldNode> collectWorldNodes(const LoadContext& context) {
  const std::vector<int> roots = rootNodes(context.model);
  // A stack of its own instead of recursion: a file may chain any number of nodes.
  std::vector<WorldNode> pending;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, glm::dmat4(1.0)});
  std::vector<WorldNode> nodes;
  while (!pending.empty()) {
    const WorldNode parent = pending.back();
    pending.pop_back();
    const WorldNode node{parent.node, parent.world * localTransform(context, parent.node)};
    if (!isFinite(node.world)) {
      throw InputError(context.where(fmt::format("/nodes/{}", node.node)),
                       "the transform to world space is not finite", "check the scales of its ancestors");
    }
    nodes.push_back(node);
    const std::vector<int>& children = context.model.nodes[static_cast<std::size_t>(node.node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      pending.push_back({*child, node.world});
  }
  return nodes;
}

std::vector<glm::dmat4> instanceTransforms(const LoadContext& context, const WorldNode& node) {
  const JsonCursor json = context.root.at("nodes").at(static_cast<std::size_t>(node.node));
  const auto instancing = LoadContext::extension(json, "EXT_mesh_gpu_instancing");
  if (!instancing) return {node.world};
  const JsonCursor attributes = instancing->at("attributes");
  const std::vector<float> translations = instanceAttribute(context, attributes, "TRANSLATION");
  const std::vector<float> rotations = instanceAttribute(context, attributes, "ROTATION");
  const std::vector<float> scales = instanceAttribute(context, attributes, "SCALE");
  const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
  const std::string path = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node.node);
  if (count == 0) {
    context.warn(path, "no TRANSLATION, ROTATION or SCALE; the mesh is drawn once");
    return {node.world};
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
    transforms.push_back(node.world * composeTransform(translation, rotation, scale));
    if (!isFinite(transforms.back())) {
      throw InputError(context.where(path), fmt::format("the transform of instance {} is not finite", i));
    }
  }
  return transforms;
}

}  // namespace prelight
