#include "scene/gltf/listed_children.h"

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "scene/gltf/json_cursor.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;
using NodeOfNodes = std::vector<std::optional<std::size_t>>;  ///< [node], another node

std::size_t indexOf(const Json& number) { return static_cast<std::size_t>(*unsignedValue(number)); }

void forEachEntry(const Json& object, const char* name, const std::function<void(std::size_t)>& visit) {
  if (const auto list = object.find(name); list != object.end())
    for (const Json& entry : *list) visit(indexOf(entry));
}

NodeOfNodes listedParents(const Json& nodes) {
  NodeOfNodes parents(nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node)
    forEachEntry(nodes[node], "children", [&](std::size_t child) { parents[child] = node; });
  return parents;
}

/// Returns the nearest marked ancestor of each node. Each node is visited once, from the roots down.
NodeOfNodes nearestAbove(const Json& nodes, const NodeOfNodes& parents, const std::vector<bool>& marked) {
  NodeOfNodes nearest(nodes.size());
  std::vector<std::size_t> pending;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (!parents[node]) pending.push_back(node);
  while (!pending.empty()) {
    const std::size_t node = pending.back();
    pending.pop_back();
    forEachEntry(nodes[node], "children", [&](std::size_t child) {
      nearest[child] = marked[node] ? std::optional(node) : nearest[node];
      pending.push_back(child);
    });
  }
  return nearest;
}

/// Removes numbers from the array `name`, and the array itself when nothing is left.
void takeOut(Json& object, const char* name, const std::function<bool(std::size_t)>& isTaken) {
  Json left = Json::array();
  forEachEntry(object, name, [&](std::size_t entry) {
    if (!isTaken(entry)) left.push_back(entry);
  });
  if (left.empty())
    object.erase(name);
  else
    object[name] = left;
}

/// The first message of a kind, and the number of such messages.
struct Told {
  std::string first;
  std::size_t count = 0;

  void add(const std::string& text) {
    if (count++ == 0) first = text;
  }
  void addTo(Warnings& warnings) const {
    if (count == 0) return;
    warnings.push_back(
        count == 1 ? first
                   : fmt::format("{}; also for {} more node{}", first, count - 1, count == 2 ? "" : "s"));
  }
};

}  // namespace

void settleListedChildren(GltfDocument& document, Warnings& warnings) {
  Json& root = document.json;
  if (!root.contains("nodes") || !root.contains("scenes")) return;
  Json& nodes = root["nodes"];
  const NodeOfNodes parents = listedParents(nodes);
  std::vector<bool> listed(nodes.size(), false);
  bool isOdd = false;
  for (const Json& scene : root["scenes"]) {
    forEachEntry(scene, "nodes", [&](std::size_t node) {
      listed[node] = true;
      isOdd = isOdd || parents[node].has_value();
    });
  }
  if (!isOdd) return;

  const NodeOfNodes above = nearestAbove(nodes, parents, listed);
  std::vector<bool> loose(nodes.size(), false);
  Told taken, left;
  for (std::size_t scene = 0; scene < root["scenes"].size(); ++scene) {
    std::vector<bool> here(nodes.size(), false);
    forEachEntry(root["scenes"][scene], "nodes", [&](std::size_t node) { here[node] = true; });
    const auto isBelowAnother = [&](std::size_t node) {
      if (!parents[node]) return false;
      const std::string where = fmt::format("{}: /scenes/{}/nodes", document.path.string(), scene);
      const std::string what =
          fmt::format("node {} is a child of node {}, expected a root node", node, *parents[node]);
      if (above[node] && !here[*above[node]])
        throw InputError(where, what, "another scene draws it below its parent");
      if (above[node]) {
        left.add(fmt::format("{}: {}; it is drawn once, as that child", where, what));
        return true;
      }
      taken.add(fmt::format("{}: {}; it is taken as one, since no scene draws its parent", where, what));
      loose[node] = true;
      return false;
    };
    takeOut(root["scenes"][scene], "nodes", isBelowAnother);
  }
  for (Json& node : nodes)
    if (node.contains("children")) takeOut(node, "children", [&](std::size_t child) { return loose[child]; });
  taken.addTo(warnings);
  left.addTo(warnings);
}

}  // namespace prelight
