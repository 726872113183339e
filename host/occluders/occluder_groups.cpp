#include "occluders/occluder_groups.h"

#include <map>

#include "plan/shadow_sets.h"

namespace prelight {

namespace {

/// Returns the number by which occluders of a kind are distinguished.
std::uint32_t keyOf(const CompiledScene& scene, const PrimitiveRange& range, OccluderKind kind) {
  switch (kind) {
    case OccluderKind::Mesh:
      return static_cast<std::uint32_t>(range.mesh);
    case OccluderKind::Material: {
      if (range.triangleCount == 0) return 0;
      const std::uint32_t material = scene.triangleMaterials[range.firstTriangle];
      const int source = scene.materials[material].source;
      return source < 0 ? material : static_cast<std::uint32_t>(source);
    }
    case OccluderKind::Node:
    case OccluderKind::Auto:
      break;
  }
  return static_cast<std::uint32_t>(range.node);
}

std::string nameOf(const PrimitiveRange& range, OccluderKind kind, std::uint32_t key) {
  switch (kind) {
    case OccluderKind::Mesh:
      return "mesh " + std::to_string(key);
    case OccluderKind::Material:
      return "material " + std::to_string(key);
    case OccluderKind::Node:
    case OccluderKind::Auto:
      break;
  }
  return nodeNameOf(range);
}

}  // namespace

OccluderGroups makeOccluderGroups(const CompiledScene& scene, OccluderKind kind) {
  OccluderGroups groups;
  groups.groupOfVertex.resize(scene.vertexCount());
  std::map<std::uint32_t, std::uint32_t> groupOfKey;
  for (const PrimitiveRange& range : scene.primitives) {
    if (range.triangleCount == 0) continue;
    const std::uint32_t key = keyOf(scene, range, kind);
    const auto [found, fresh] = groupOfKey.try_emplace(key, static_cast<std::uint32_t>(groups.names.size()));
    if (fresh) groups.names.push_back(nameOf(range, kind, key));
    for (std::uint32_t v = 0; v < range.vertexCount; ++v)
      groups.groupOfVertex[range.firstVertex + v] = found->second;
  }
  return groups;
}

std::vector<std::uint32_t> leafNodes(const OccluderTree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t node = 0; node < tree.size(); ++node)
    if (tree.isLeaf(node)) leaves.push_back(node);
  return leaves;
}

OccluderGroups leavesOf(const OccluderTree& tree) {
  const std::vector<std::uint32_t> leaves = leafNodes(tree);
  std::vector<std::uint32_t> groupOfNode(tree.size(), 0);
  OccluderGroups groups;
  for (std::uint32_t g = 0; g < leaves.size(); ++g) {
    groupOfNode[leaves[g]] = g;
    groups.names.push_back(tree.names[leaves[g]]);
  }
  for (const std::uint32_t leaf : tree.leafOfVertex) groups.groupOfVertex.push_back(groupOfNode[leaf]);
  return groups;
}

}  // namespace prelight
