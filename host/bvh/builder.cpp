#include "bvh/builder.h"

#include <chrono>
#include <utility>

#include "bvh/collapse.h"
#include "bvh/morton_tree.h"
#include "bvh/top_down.h"

namespace prelight {

namespace {

// Chosen by numbers of steps and by memory: see docs/notes/bvh.md.
constexpr TraversalCosts wideCosts{.node = 1.0, .leaf = 1.0, .triangle = 0.0};
constexpr TraversalCosts narrowCosts{.node = 1.2, .leaf = 0.0, .triangle = 1.0};
constexpr double highSplitBudget = 0.3;

/// Builds a tree by the surface area heuristic, in which spatial splits may add triangles up to a share of
/// the scene's.
BinaryBvh buildBySurface(const CompiledScene& scene, const BvhOptions& options, double splitBudget) {
  const bool wide = options.target == BvhTarget::Wide;
  return buildTopDown(scene, {.price = wide ? LeafPrice::Blocks : LeafPrice::Triangles,
                              .leafSize = wide ? 4u : 1u,
                              .splitBudget = splitBudget,
                              .threads = options.threads,
                              .triangles = options.triangles});
}

BinaryBvh collapse(const BinaryBvh& bvh, const BvhOptions& options) {
  return options.target == BvhTarget::Wide ? collapseToWide(bvh, wideCosts, options.threads)
                                           : collapseLeaves(bvh, narrowCosts, options.threads);
}

double costOf(const BinaryBvh& bvh, BvhTarget target) {
  const bool wide = target == BvhTarget::Wide;
  const TraversalCosts& costs = wide ? wideCosts : narrowCosts;
  double sum = 0.0;
  for (const BinaryBvh::Node& node : bvh.nodes)
    if (node.count > 0 || node.wideRoot || !wide)
      sum += node.bounds.halfArea() * (node.count > 0 ? costs.ofLeaf(node.count) : costs.node);
  return sum;
}

BinaryBvh build(const CompiledScene& scene, const BvhOptions& options) {
  if (options.quality == BuildQuality::Fast && options.triangles.empty())
    return collapse(buildMortonTree(scene, options.threads), options);
  BinaryBvh plain = collapse(buildBySurface(scene, options, 0.0), options);
  if (options.quality != BuildQuality::High) return plain;
  // Each spatial split is the cheaper choice where it is made, but the tree is not always cheaper in the end.
  BinaryBvh split = collapse(buildBySurface(scene, options, highSplitBudget), options);
  return costOf(split, options.target) < costOf(plain, options.target) ? std::move(split) : std::move(plain);
}

}  // namespace

BinaryBvh buildBvh(const CompiledScene& scene, const BvhOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  BinaryBvh bvh = build(scene, options);
  bvh.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return bvh;
}

void refitBvh(BinaryBvh& bvh, const CompiledScene& scene) {
  for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
    BinaryBvh::Node& node = bvh.nodes[n];
    if (node.count == 0) {
      node.bounds = unite(bvh.nodes[node.left].bounds, bvh.nodes[node.right].bounds);
      continue;
    }
    node.bounds = {};
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      for (int corner = 0; corner < 3; ++corner)
        node.bounds.grow(scene.positions[scene.triangles[bvh.triangleOrder[i]][corner]]);
  }
}

}  // namespace prelight
