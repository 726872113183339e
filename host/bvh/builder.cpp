#include "bvh/builder.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <limits>
#include <utility>

#include "bvh/morton_tree.h"
#include "bvh/top_down.h"

namespace prelight {

namespace {

constexpr std::uint32_t width = 8;
constexpr double never = std::numeric_limits<double>::infinity();

/// Decisions for a node. The i-th (1..8) says how its subtree fills i children of a wide node: 0, in the same
/// way as i - 1 children; k, its left child fills k of them and its right child i - k.
class Decisions {
 public:
  void set(std::uint32_t slots, std::uint32_t leftSlots) {
    bits_ = (bits_ & ~(7u << shift(slots))) | leftSlots << shift(slots);
  }
  std::uint32_t of(std::uint32_t slots) const { return bits_ >> shift(slots) & 7u; }
  void setLeaf() { bits_ |= 0x80000000u; }
  bool isLeaf() const { return bits_ & 0x80000000u; }

 private:
  static std::uint32_t shift(std::uint32_t slots) { return 3 * (slots - 2); }
  std::uint32_t bits_ = 0;
};

/// The least costs of a subtree that fills at most i children of a wide node (index i - 1), and its number of
/// triangles.
struct Costs {
  std::array<double, width - 1> of{};
  std::uint32_t triangles = 0;
};

class Optimizer {
 public:
  Optimizer(const BinaryBvh& bvh, const TraversalCosts& costs, bool wide)
      : bvh_(bvh), costs_(costs), wide_(wide), decisions_(bvh.nodes.size()) {}

  /// Decides for all nodes; the upper levels fork until there are at least four times as many tasks as
  /// threads.
  void decide(std::size_t threads) {
    int forks = 0;
    while ((std::size_t{1} << forks) < 4 * threads && threads > 1) ++forks;
    decideSubtree(0, forks);
  }

  BinaryBvh emit() {
    out_.nodes.emplace_back();
    emitNode(0, 0, 1, 1);
    return std::move(out_);
  }

 private:
  Costs decideSubtree(std::uint32_t index, int forks) {
    const BinaryBvh::Node& node = bvh_.nodes[index];
    const double area = node.bounds.halfArea();
    if (node.count > 0) {
      decisions_[index].setLeaf();
      Costs costs;
      costs.of.fill(area * costs_.ofLeaf(node.count));
      costs.triangles = node.count;
      return costs;
    }
    Costs left, right;
    if (forks > 0) {
      auto other = std::async(std::launch::async, [&] { return decideSubtree(node.right, forks - 1); });
      left = decideSubtree(node.left, forks - 1);
      right = other.get();
    } else {
      left = decideSubtree(node.left, 0);
      right = decideSubtree(node.right, 0);
    }
    return wide_ ? decideWide(decisions_[index], area, left, right)
                 : decideLeaf(decisions_[index], area, left, right);
  }

  double leafCost(double area, std::uint32_t triangles) const {
    return triangles <= costs_.mostTriangles ? area * costs_.ofLeaf(triangles) : never;
  }

  Costs decideWide(Decisions& decisions, double area, const Costs& left, const Costs& right) const {
    Costs costs;
    costs.triangles = left.triangles + right.triangles;
    const auto distribute = [&](std::uint32_t slots) {
      double least = never;
      for (std::uint32_t k = 1; k < slots; ++k) {
        const double cost = left.of[k - 1] + right.of[slots - k - 1];
        if (cost < least) {
          least = cost;
          decisions.set(slots, k);
        }
      }
      return least;
    };
    const double asNode = distribute(width) + area * costs_.node;
    const double asLeaf = leafCost(area, costs.triangles);
    if (asLeaf <= asNode) decisions.setLeaf();
    costs.of[0] = std::min(asLeaf, asNode);
    for (std::uint32_t slots = 2; slots < width; ++slots) {
      costs.of[slots - 1] = distribute(slots);
      if (costs.of[slots - 1] < costs.of[slots - 2]) continue;
      costs.of[slots - 1] = costs.of[slots - 2];
      decisions.set(slots, 0);
    }
    return costs;
  }

  Costs decideLeaf(Decisions& decisions, double area, const Costs& left, const Costs& right) const {
    Costs costs;
    costs.triangles = left.triangles + right.triangles;
    const double asNode = left.of[0] + right.of[0] + area * costs_.node;
    const double asLeaf = leafCost(area, costs.triangles);
    if (asLeaf <= asNode) decisions.setLeaf();
    costs.of[0] = std::min(asLeaf, asNode);
    return costs;
  }

  /// Copies a subtree that fills `slots` children of the wide node above it.
  void emitNode(std::uint32_t from, std::uint32_t to, std::uint32_t slots, std::uint32_t level) {
    while (slots > 1 && decisions_[from].of(slots) == 0) --slots;
    out_.nodes[to].bounds = bvh_.nodes[from].bounds;
    out_.depth = std::max(out_.depth, level);
    if (slots == 1) {
      if (decisions_[from].isLeaf()) return emitLeaf(from, to);
      out_.nodes[to].wideRoot = wide_ ? 1 : 0;
      slots = width;
    }
    const std::uint32_t leftSlots = wide_ ? decisions_[from].of(slots) : 1;
    const auto child = static_cast<std::uint32_t>(out_.nodes.size());
    out_.nodes[to].left = child;
    out_.nodes[to].right = child + 1;
    out_.nodes.resize(child + 2);
    emitNode(bvh_.nodes[from].left, child, leftSlots, level + 1);
    emitNode(bvh_.nodes[from].right, child + 1, wide_ ? slots - leftSlots : 1, level + 1);
  }

  void emitLeaf(std::uint32_t from, std::uint32_t to) {
    const std::size_t first = out_.triangleOrder.size();
    gather(from);
    const auto begin = out_.triangleOrder.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, out_.triangleOrder.end());
    out_.triangleOrder.erase(std::unique(begin, out_.triangleOrder.end()), out_.triangleOrder.end());
    out_.nodes[to].first = static_cast<std::uint32_t>(first);
    out_.nodes[to].count = static_cast<std::uint32_t>(out_.triangleOrder.size() - first) & 0x7fffffffu;
  }

  void gather(std::uint32_t index) {
    const BinaryBvh::Node& node = bvh_.nodes[index];
    if (node.count == 0) {
      gather(node.left);
      gather(node.right);
      return;
    }
    const auto begin = bvh_.triangleOrder.begin() + node.first;
    out_.triangleOrder.insert(out_.triangleOrder.end(), begin, begin + node.count);
  }

  const BinaryBvh& bvh_;
  TraversalCosts costs_;
  bool wide_;
  std::vector<Decisions> decisions_;
  BinaryBvh out_;
};

BinaryBvh optimized(const BinaryBvh& bvh, const TraversalCosts& costs, bool wide, std::size_t threads) {
  Optimizer optimizer(bvh, costs, wide);
  optimizer.decide(threads);
  return optimizer.emit();
}

}  // namespace

BinaryBvh collapseToWide(const BinaryBvh& bvh, const TraversalCosts& costs, std::size_t threads) {
  return optimized(bvh, costs, true, threads);
}

BinaryBvh collapseLeaves(const BinaryBvh& bvh, const TraversalCosts& costs, std::size_t threads) {
  return optimized(bvh, costs, false, threads);
}

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

}  // namespace prelight
