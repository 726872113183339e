#include "bvh/bvh_report.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "bvh/two_level.h"
#include "shared/bvh_types.h"

namespace prelight {

namespace {

/// Returns the number of levels of layout nodes and leaves from the root down.
std::uint32_t layoutDepth(const BinaryBvh& bvh, BvhTarget target) {
  std::vector<std::uint32_t> levels(bvh.nodes.size(), 1);
  std::uint32_t deepest = 1;
  for (std::size_t n = 0; n < bvh.nodes.size(); ++n) {
    const BinaryBvh::Node& node = bvh.nodes[n];
    deepest = std::max(deepest, levels[n]);
    if (node.count > 0) continue;
    for (const std::uint32_t child : {node.left, node.right}) {
      const bool own = target == BvhTarget::Narrow || bvh.nodes[child].count > 0 || bvh.nodes[child].wideRoot;
      levels[child] = levels[n] + (own ? 1 : 0);
    }
  }
  return deepest;
}

}  // namespace

BvhReport reportOf(const BinaryBvh& bvh, std::size_t sceneTriangles, BvhTarget target) {
  const bool wide = target == BvhTarget::Wide;
  BvhReport report;
  double area = 0.0;
  for (const BinaryBvh::Node& node : bvh.nodes) {
    if (node.count > 0) {
      ++report.leaves;
      area += node.bounds.halfArea() * (wide ? 1.0 : static_cast<double>(node.count));
    } else if (!wide || node.wideRoot) {
      ++report.nodes;
      area += node.bounds.halfArea();
    }
  }
  const double rootArea = bvh.nodes[0].bounds.halfArea();
  const auto named = static_cast<double>(bvh.triangleOrder.size());
  const auto triangles = static_cast<double>(sceneTriangles);
  const auto nodes = static_cast<double>(report.nodes), leaves = static_cast<double>(report.leaves);
  const double bytes = wide ? nodes * sizeof(device::WideNode) + leaves * sizeof(device::TriangleBlock)
                            : nodes * sizeof(device::NarrowNode) + named * sizeof(device::NarrowTriangle);
  report.sahCost = rootArea > 0.0 ? area / rootArea : 0.0;
  report.depth = layoutDepth(bvh, target);
  report.meanLeafFill = named / (leaves * BinaryBvh::maxLeafSize);
  report.duplicates = named / triangles - 1.0;
  report.bytesPerTriangle = bytes / triangles;
  report.seconds = bvh.buildSeconds;
  return report;
}

TwoLevelReport reportTwoLevel(const CompiledScene& scene, std::span<const std::uint32_t> instances) {
  const auto start = std::chrono::steady_clock::now();
  const auto tree = buildTwoLevel<WideBvh>(scene, divideContents(scene, instances, {}), {});
  TwoLevelReport report;
  report.instances = tree.instances.size();
  report.nodes = tree.bvh.nodes.size();
  report.leaves = tree.bvh.blocks.size();
  report.bytes = report.nodes * sizeof(device::WideNode) + report.leaves * sizeof(device::TriangleBlock) +
                 report.instances * sizeof(device::DeviceInstance);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace prelight
