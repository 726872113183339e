#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

void validateBindMatrices(const JsonCursor& root, const JsonCursor& matrices, std::size_t joints) {
  const std::size_t index = matrices.asIndex(root.countOf("accessors"), "accessor");
  const JsonCursor accessor = root.at("accessors").at(index);
  constexpr std::uint64_t matrixFloat = 5126;
  const std::string type = accessor.at("type").asString();
  const std::uint64_t component = accessor.at("componentType").asUnsigned();
  if (type != "MAT4" || component != matrixFloat)
    matrices.fail(fmt::format("expected matrices of type MAT4 and component type {}, got {} and {}",
                              matrixFloat, type, component));
  if (const std::uint64_t count = accessor.at("count").asUnsigned(); count < joints)
    matrices.fail(fmt::format("{} matrices, expected {}: one for each joint", count, joints),
                  "export the skin again");
}

void validateSkin(const JsonCursor& root, const JsonCursor& skin) {
  skin.stringOr("name", "");
  const std::size_t nodes = root.countOf("nodes");
  const JsonCursor joints = skin.at("joints");
  if (joints.arraySize() == 0) joints.fail("expected a joint at least, got none");
  std::vector<bool> listed(nodes, false);
  for (std::size_t i = 0; i < joints.arraySize(); ++i) {
    const std::size_t node = joints.at(i).asIndex(nodes, "node");
    if (listed[node]) joints.at(i).fail(fmt::format("node {} is listed twice", node));
    listed[node] = true;
  }
  if (const auto skeleton = skin.find("skeleton")) skeleton->asIndex(nodes, "node");
  if (const auto matrices = skin.find("inverseBindMatrices"))
    validateBindMatrices(root, *matrices, joints.arraySize());
}

/// Returns the root of the tree of each node. The hierarchy must be acyclic.
std::vector<std::size_t> rootsOfNodes(const JsonCursor& root) {
  const std::size_t count = root.countOf("nodes");
  std::vector<std::size_t> parents(count), roots(count);
  for (std::size_t i = 0; i < count; ++i) parents[i] = i;
  root.forEachObject("nodes", [&](const JsonCursor& node, std::size_t index) {
    const auto children = node.find("children");
    for (std::size_t i = 0; children && i < children->arraySize(); ++i)
      parents[children->at(i).asUnsigned()] = index;
  });
  // Each path to the root is halved while it is followed, so that chains of any length are fast.
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t at = i;
    while (parents[at] != parents[parents[at]]) at = parents[at] = parents[parents[at]];
    roots[i] = parents[at];
  }
  return roots;
}

/// Warns of skins without a common root. glTF requires one node above all joints; skinning works without.
void warnOfRoots(const JsonCursor& skin, const std::vector<std::size_t>& roots, Warnings& warnings) {
  const JsonCursor joints = skin.at("joints");
  const std::size_t first = joints.at(0).asUnsigned();
  for (std::size_t i = 1; i < joints.arraySize(); ++i) {
    if (roots[joints.at(i).asUnsigned()] == roots[first]) continue;
    warnings.push_back(fmt::format("{}: no node is above both it and joint 0", joints.at(i).where()));
    return;
  }
}

/// Returns the greatest number of morph targets of a mesh's primitives.
std::size_t targetsOf(const JsonCursor& mesh) {
  std::size_t most = 0;
  mesh.forEachObject("primitives", [&](const JsonCursor& primitive, std::size_t) {
    most = std::max(most, primitive.countOf("targets"));
  });
  return most;
}

void warnOfWeights(const JsonCursor& holder, std::size_t targets, Warnings& warnings) {
  const auto weights = holder.find("weights");
  if (!weights) return;
  const std::size_t count = weights->arraySize();
  for (std::size_t i = 0; i < count; ++i) weights->at(i).asNumber();
  if (count != targets)
    warnings.push_back(fmt::format("{}: {} weights for {} morph targets; {}", weights->where(), count,
                                   targets, count < targets ? "the others are 0" : "the rest is left out"));
}

/// Warns of target attributes that the primitive lacks, which have no effect.
void warnOfAttributes(const JsonCursor& primitive, Warnings& warnings) {
  const JsonCursor attributes = primitive.at("attributes");
  primitive.forEachObject("targets", [&](const JsonCursor& target, std::size_t) {
    target.forEachMember([&](const JsonCursor& attribute, const std::string& name) {
      if (!attributes.find(name))
        warnings.push_back(fmt::format("{}: the primitive has no {}; left out", attribute.where(), name));
    });
  });
}

void warnOfMesh(const JsonCursor& mesh, Warnings& warnings) {
  const std::size_t most = targetsOf(mesh);
  warnOfWeights(mesh, most, warnings);
  if (most == 0) return;
  mesh.forEachObject("primitives", [&](const JsonCursor& primitive, std::size_t) {
    warnOfAttributes(primitive, warnings);
    if (const std::size_t count = primitive.countOf("targets"); count != most)
      warnings.push_back(
          fmt::format("{}: {} morph targets, another primitive of the mesh has {}; those that it lacks move "
                      "nothing of it",
                      primitive.where(), count, most));
  });
}

}  // namespace

void validateSkins(const JsonCursor& root, const GltfUse& use, Warnings& warnings) {
  std::vector<std::size_t> roots;
  root.forEachObject("skins", [&](const JsonCursor& skin, std::size_t index) {
    checkPart(use.skins.contains(index), warnings, [&] {
      validateSkin(root, skin);
      if (roots.empty()) roots = rootsOfNodes(root);
      warnOfRoots(skin, roots, warnings);
    });
  });
}

void warnOfMorphs(const JsonCursor& root, Warnings& warnings) {
  std::map<std::uint64_t, std::size_t> targets;  // number of targets of meshes that nodes with weights draw
  root.forEachObject("meshes", [&](const JsonCursor& mesh, std::size_t) { warnOfMesh(mesh, warnings); });
  root.forEachObject("nodes", [&](const JsonCursor& node, std::size_t) {
    const auto mesh = node.find("mesh");
    for (const char* member : {"skin", "weights"})
      if (const auto of = node.find(member); of && !mesh)
        warnings.push_back(fmt::format("{}: the node has no mesh; ignored", of->where()));
    if (!mesh || !node.find("weights")) return;
    const auto [known, fresh] = targets.try_emplace(mesh->asUnsigned());
    if (fresh) known->second = targetsOf(root.at("meshes").at(known->first));
    warnOfWeights(node, known->second, warnings);
  });
}

}  // namespace prelight
