#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

constexpr std::int64_t noParent = -1;

void validateInstancing(const JsonCursor& root, const JsonCursor& extension) {
  const JsonCursor attributes = extension.at("attributes");
  attributes.expectObject();
  std::uint64_t instances = 0;
  for (const auto& [name, type] : {std::pair<const char*, const char*>{"TRANSLATION", "VEC3"},
                                   {"ROTATION", "VEC4"},
                                   {"SCALE", "VEC3"}}) {
    const auto attribute = attributes.find(name);
    if (!attribute) continue;
    const JsonCursor accessor =
        root.at("accessors").at(attribute->asIndex(root.countOf("accessors"), "accessor"));
    if (accessor.at("type").asString() != type) {
      attribute->fail(
          fmt::format("expected an accessor of type {}, got {}", type, accessor.at("type").asString()));
    }
    const std::uint64_t count = accessor.at("count").asUnsigned();
    if (instances != 0 && count != instances) {
      attribute->fail(fmt::format("{} instances, but another attribute has {}", count, instances));
    }
    instances = count;
  }
}

std::size_t countLights(const JsonCursor& root, const char* extension) {
  const auto extensions = root.find("extensions");
  const auto lights = extensions ? extensions->find(extension) : std::nullopt;
  return lights ? lights->countOf("lights") : 0;
}

void validateProfiled(const JsonCursor& root, const JsonCursor& light) {
  light.at("light").asIndex(countLights(root, "EXT_lights_ies"), "light profile");
  light.numberOr("multiplier", 1.0);
  if (const auto color = light.find("color")) color->expectNumbers(3);
}

void validateNodeExtensions(const JsonCursor& root, const JsonCursor& node, std::size_t lights) {
  const auto extensions = node.find("extensions");
  if (!extensions) return;
  if (const auto punctual = extensions->find("KHR_lights_punctual"))
    punctual->at("light").asIndex(lights, "light");
  if (const auto profiled = extensions->find("EXT_lights_ies")) validateProfiled(root, *profiled);
  if (const auto instancing = extensions->find("EXT_mesh_gpu_instancing"))
    validateInstancing(root, *instancing);
}

void validateNode(const JsonCursor& root, const JsonCursor& node, std::size_t lights) {
  node.stringOr("name", "");
  for (const auto& [member, array, kind] :
       {std::tuple{"mesh", "meshes", "mesh"}, {"camera", "cameras", "camera"}, {"skin", "skins", "skin"}}) {
    if (const auto reference = node.find(member)) reference->asIndex(root.countOf(array), kind);
  }
  for (const auto& [member, numbers] :
       {std::pair{"matrix", std::size_t{16}}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}) {
    if (const auto values = node.find(member)) values->expectNumbers(numbers);
  }
  validateNodeExtensions(root, node, lights);
}

std::vector<std::int64_t> findParents(const JsonCursor& root, std::size_t nodeCount) {
  std::vector<std::int64_t> parents(nodeCount, noParent);
  root.forEachObject("nodes", [&](const JsonCursor& node, std::size_t index) {
    const auto children = node.find("children");
    const std::size_t count = children ? children->arraySize() : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const JsonCursor child = children->at(i);
      const std::size_t target = child.asIndex(nodeCount, "node");
      if (parents[target] != noParent) {
        child.fail(fmt::format("node {} is already a child of node {}, expected one parent", target,
                               parents[target]));
      }
      parents[target] = static_cast<std::int64_t>(index);
    }
  });
  return parents;
}

/// Checks that nodes have no cycles. As each has one parent at most, nodes from which going up reaches no
/// root form cycles. Each node is visited once.
void validateAcyclic(const JsonCursor& root, const std::vector<std::int64_t>& parents) {
  enum class State : std::uint8_t { Unknown, OnPath, ReachesRoot };
  std::vector<State> states(parents.size(), State::Unknown);
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < parents.size(); ++start) {
    path.clear();
    auto node = static_cast<std::int64_t>(start);
    while (node != noParent && states[node] == State::Unknown) {
      states[node] = State::OnPath;
      path.push_back(static_cast<std::size_t>(node));
      node = parents[node];
    }
    if (node != noParent && states[node] == State::OnPath) {
      root.at("nodes")
          .at(static_cast<std::size_t>(node))
          .fail("the node is its own ancestor, expected a tree");
    }
    for (const std::size_t visited : path) states[visited] = State::ReachesRoot;
  }
}

void validateScenes(const JsonCursor& root, std::size_t nodeCount) {
  if (const auto scene = root.find("scene")) scene->asIndex(root.countOf("scenes"), "scene");
  root.forEachObject("scenes", [&](const JsonCursor& scene, std::size_t) {
    std::vector<bool> listed(nodeCount, false);
    const auto nodes = scene.find("nodes");
    const std::size_t count = nodes ? nodes->arraySize() : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const JsonCursor entry = nodes->at(i);
      const std::size_t node = entry.asIndex(nodeCount, "node");
      if (listed[node]) entry.fail(fmt::format("node {} is listed twice", node));
      listed[node] = true;
    }
  });
}

}  // namespace

void validateNodes(const JsonCursor& root) {
  const std::size_t lights = countLights(root, "KHR_lights_punctual");
  root.forEachObject("nodes", [&](const JsonCursor& node, std::size_t) { validateNode(root, node, lights); });
  const std::vector<std::int64_t> parents = findParents(root, root.countOf("nodes"));
  validateAcyclic(root, parents);
  validateScenes(root, parents.size());
}

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
