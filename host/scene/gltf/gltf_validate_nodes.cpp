#include <fmt/format.h>

#include <cstdint>
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

}  // namespace prelight
