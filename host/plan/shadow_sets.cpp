#include "plan/shadow_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight {

namespace {

using NodeMask = std::vector<bool>;  // [node of `Nodes`]

/// The nodes with meshes, in the order of the scene's primitives.
struct Nodes {
  std::vector<std::string> names;
  std::vector<std::size_t> ofPrimitive;  ///< [primitive], index into names
};

Nodes nodesOf(const CompiledScene& scene) {
  Nodes nodes;
  std::map<int, std::size_t> known;
  for (const PrimitiveRange& range : scene.primitives) {
    const auto [at, fresh] = known.emplace(range.node, nodes.names.size());
    if (fresh) nodes.names.push_back(nodeNameOf(range));
    nodes.ofPrimitive.push_back(at->second);
  }
  return nodes;
}

NodeMask matching(const Nodes& nodes, const std::vector<std::string>& patterns, const std::string& where) {
  NodeMask mask(nodes.names.size(), false);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t n = 0; n < mask.size(); ++n) {
      if (!matchesPattern(nodes.names[n], pattern)) continue;
      mask[n] = any = true;
    }
    if (any) continue;
    const std::set<std::string> names(nodes.names.begin(), nodes.names.end());
    throw UsageError("BakeRequest::shadowSets " + where,
                     fmt::format("no node with a mesh matches '{}'", pattern),
                     fmt::format("the nodes are: {}", fmt::join(names, ", ")));
  }
  return mask;
}

std::string textOf(const ShadowSetRequest& request) {
  return fmt::format("{}:{}", fmt::join(request.receivers, ","), fmt::join(request.occluders, ","));
}

ShadowSets::Occluders occludersOf(const CompiledScene& scene, const Nodes& nodes, const NodeMask& mask) {
  ShadowSets::Occluders set;
  set.nodes = static_cast<std::uint32_t>(std::count(mask.begin(), mask.end(), true));
  for (std::size_t p = 0; p < scene.primitives.size(); ++p) {
    if (!mask[nodes.ofPrimitive[p]]) continue;
    const PrimitiveRange& range = scene.primitives[p];
    for (std::uint32_t t = 0; t < range.triangleCount; ++t) set.triangles.push_back(range.firstTriangle + t);
  }
  std::sort(set.triangles.begin(), set.triangles.end());
  return set;
}

}  // namespace

std::uint64_t ShadowSets::treeTriangles() const {
  std::uint64_t count = 0;
  for (const Occluders& set : sets) count += set.triangles.size();
  return count;
}

std::vector<std::uint32_t> ShadowSets::setOfVertices(const CompiledScene& scene) const {
  std::vector<std::uint32_t> ofVertex;
  if (empty()) return ofVertex;
  ofVertex.assign(scene.vertexCount(), 0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) ofVertex[scene.triangles[t][k]] = setOfTriangle[t];
  return ofVertex;
}

std::string nodeNameOf(const PrimitiveRange& range) {
  return range.name.empty() ? fmt::format("node {}", range.node) : range.name;
}

ShadowSets makeShadowSets(const CompiledScene& scene, const std::vector<ShadowSetRequest>& requests) {
  ShadowSets out;
  if (requests.empty()) return out;
  const Nodes nodes = nodesOf(scene);
  std::vector<NodeMask> seen(nodes.names.size());  // [node], mask of the nodes it sees; empty: everything
  for (const ShadowSetRequest& request : requests) {
    const NodeMask receivers = matching(nodes, request.receivers, textOf(request));
    const NodeMask occluders = matching(nodes, request.occluders, textOf(request));
    for (std::size_t n = 0; n < receivers.size(); ++n) {
      if (!receivers[n]) continue;
      seen[n].resize(nodes.names.size(), false);
      for (std::size_t o = 0; o < occluders.size(); ++o) seen[n][o] = seen[n][o] || occluders[o];
    }
  }
  std::map<NodeMask, std::uint32_t> sets;
  std::vector<std::uint32_t> setOfNode(nodes.names.size(), 0);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (seen[n].empty() || std::find(seen[n].begin(), seen[n].end(), false) == seen[n].end()) continue;
    const auto [at, fresh] = sets.emplace(seen[n], static_cast<std::uint32_t>(out.sets.size() + 1));
    if (fresh) out.sets.push_back(occludersOf(scene, nodes, seen[n]));
    setOfNode[n] = at->second;
    ++out.sets[at->second - 1].receivers;
  }
  if (out.empty()) return out;
  out.setOfTriangle.assign(scene.triangleCount(), 0);
  for (std::size_t p = 0; p < scene.primitives.size(); ++p) {
    const PrimitiveRange& range = scene.primitives[p];
    std::fill_n(out.setOfTriangle.begin() + range.firstTriangle, range.triangleCount,
                setOfNode[nodes.ofPrimitive[p]]);
  }
  return out;
}

}  // namespace prelight
