#include "bvh/layouts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace prelight {

namespace {

using device::NarrowNode;
using device::NarrowTriangle;
using device::TriangleBlock;
using device::WideNode;

/// Enlarges boxes by about an ulp of their own coordinates and of the scene's: a ray in the plane of a box
/// face, or along an axis, must not miss it due to rounding.
class Padding {
 public:
  explicit Padding(const CompiledScene& scene) {
    const glm::vec3 most = glm::max(glm::abs(scene.boundsMin), glm::abs(scene.boundsMax));
    scenePad_ = 0x1p-24f * std::max({most.x, most.y, most.z, std::numeric_limits<float>::min()});
  }

  Box operator()(const Box& box) const {
    const glm::vec3 pad = 0x1p-23f * glm::max(glm::abs(box.lower), glm::abs(box.upper)) + scenePad_;
    return {box.lower - pad, box.upper + pad};
  }

 private:
  float scenePad_;
};

/// Converts leaves of a tree over triangles to blocks, and their boxes to those of the layout.
class BlockLeaves {
 public:
  BlockLeaves(const BinaryBvh& bvh, const CompiledScene& scene) : bvh_(bvh), scene_(scene), padding_(scene) {}

  Box box(const Box& box) const { return padding_(box); }

  std::uint32_t reference(const BinaryBvh::Node& leaf) {
    TriangleBlock block{};
    for (std::uint32_t lane = 0; lane < PRELIGHT_WIDTH; ++lane) {
      block.triangle[lane] = lane < leaf.count ? bvh_.triangleOrder[leaf.first + lane] : unused;
      if (lane >= leaf.count) continue;
      for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis)
          block.vertex[corner][axis][lane] =
              scene_.positions[scene_.triangles[block.triangle[lane]][corner]][axis];
    }
    blocks_.push_back(block);
    return PRELIGHT_LEAF_BIT | static_cast<std::uint32_t>(blocks_.size() - 1);
  }

  std::vector<TriangleBlock> take() { return std::move(blocks_); }

 private:
  static constexpr std::uint32_t unused = 0xffffffffu;

  const BinaryBvh& bvh_;
  const CompiledScene& scene_;
  Padding padding_;
  std::vector<TriangleBlock> blocks_;
};

/// Converts leaves of a tree over triangles to those of the narrow layout, and their boxes.
class TriangleLeaves {
 public:
  TriangleLeaves(const BinaryBvh& bvh, const CompiledScene& scene)
      : bvh_(bvh), scene_(scene), padding_(scene) {}

  Box box(const Box& box) const { return padding_(box); }

  std::uint32_t reference(const BinaryBvh::Node& leaf) {
    const auto first = static_cast<std::uint32_t>(triangles_.size());
    for (std::uint32_t i = 0; i < leaf.count; ++i) addTriangle(bvh_.triangleOrder[leaf.first + i]);
    return PRELIGHT_LEAF_BIT | leaf.count << PRELIGHT_LEAF_COUNT_SHIFT | first;
  }

  std::vector<NarrowTriangle> take() { return std::move(triangles_); }

 private:
  void addTriangle(std::uint32_t triangle) {
    NarrowTriangle t{};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        t.vertex[corner][axis] = scene_.positions[scene_.triangles[triangle][corner]][axis];
    t.triangle = triangle;
    triangles_.push_back(t);
  }

  const BinaryBvh& bvh_;
  const CompiledScene& scene_;
  Padding padding_;
  std::vector<NarrowTriangle> triangles_;
};

/// Leaves of one object each, for which children exist already.
class GivenLeaves {
 public:
  GivenLeaves(const BinaryBvh& bvh, std::span<const std::uint32_t> children)
      : bvh_(bvh), children_(children) {}

  Box box(const Box& box) const { return box; }
  std::uint32_t reference(const BinaryBvh::Node& leaf) const {
    return children_[bvh_.triangleOrder[leaf.first]];
  }

 private:
  const BinaryBvh& bvh_;
  std::span<const std::uint32_t> children_;
};

template <typename Leaves>
class WideCollapse {
 public:
  WideCollapse(const BinaryBvh& bvh, Leaves& leaves) : bvh_(bvh), leaves_(leaves) {}

  WideBvh run() {
    out_.nodes.emplace_back();
    fillNode(0, gatherChildren(0), 1);
    out_.stackSize = 7 * depth_ + 8;
    return std::move(out_);
  }

 private:
  struct Children {
    std::array<std::uint32_t, PRELIGHT_WIDTH> node{};
    std::uint32_t count = 0;
  };

  /// Returns the children of a wide node: the nearest leaves and wide nodes below it.
  Children gatherChildren(std::uint32_t root) const {
    Children children;
    if (bvh_.nodes[root].count > 0) {
      children.node[children.count++] = root;
    } else {
      gather(bvh_.nodes[root].left, children);
      gather(bvh_.nodes[root].right, children);
    }
    return children;
  }

  void gather(std::uint32_t index, Children& children) const {
    const auto& node = bvh_.nodes[index];
    if (node.count > 0 || node.wideRoot) {
      assert(children.count < PRELIGHT_WIDTH);
      children.node[children.count++] = index;
      return;
    }
    gather(node.left, children);
    gather(node.right, children);
  }

  void fillNode(std::uint32_t slot, const Children& children, std::uint32_t level) {
    depth_ = std::max(depth_, level);
    WideNode wide{};
    for (std::uint32_t i = 0; i < PRELIGHT_WIDTH; ++i) {
      if (i >= children.count) {
        for (int axis = 0; axis < 3; ++axis) {
          wide.lower[axis][i] = std::numeric_limits<float>::infinity();
          wide.upper[axis][i] = -std::numeric_limits<float>::infinity();
        }
        wide.child[i] = PRELIGHT_LEAF_BIT;
        continue;
      }
      const auto& node = bvh_.nodes[children.node[i]];
      const Box box = leaves_.box(node.bounds);
      for (int axis = 0; axis < 3; ++axis) {
        wide.lower[axis][i] = box.lower[axis];
        wide.upper[axis][i] = box.upper[axis];
      }
      if (node.count > 0) {
        wide.child[i] = leaves_.reference(node);
      } else {
        const auto child = static_cast<std::uint32_t>(out_.nodes.size());
        out_.nodes.emplace_back();
        wide.child[i] = child;
        fillNode(child, gatherChildren(children.node[i]), level + 1);
      }
    }
    out_.nodes[slot] = wide;
  }

  const BinaryBvh& bvh_;
  Leaves& leaves_;
  WideBvh out_;
  std::uint32_t depth_ = 0;
};

template <typename Leaves>
class NarrowCollapse {
 public:
  NarrowCollapse(const BinaryBvh& bvh, Leaves& leaves) : bvh_(bvh), leaves_(leaves) {}

  NarrowBvh run() {
    const auto& root = bvh_.nodes[0];
    out_.nodes.emplace_back();
    if (root.count > 0) {
      // A single leaf becomes both children: the second child has an inverted box.
      NarrowNode node{};
      setChild(node, 0, 0, reference(0));
      for (int axis = 0; axis < 3; ++axis) {
        node.lower[1][axis] = std::numeric_limits<float>::max();
        node.upper[1][axis] = std::numeric_limits<float>::max();
      }
      node.child[1] = PRELIGHT_LEAF_BIT;
      out_.nodes[0] = node;
    } else {
      fillNode(0, 0);
    }
    out_.stackSize = bvh_.depth + 2;
    return std::move(out_);
  }

 private:
  void setChild(NarrowNode& node, int side, std::uint32_t source, std::uint32_t child) const {
    const Box box = leaves_.box(bvh_.nodes[source].bounds);
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[side][axis] = box.lower[axis];
      node.upper[side][axis] = box.upper[axis];
    }
    node.child[side] = child;
  }

  std::uint32_t reference(std::uint32_t source) {
    const auto& node = bvh_.nodes[source];
    if (node.count > 0) return leaves_.reference(node);
    const auto slot = static_cast<std::uint32_t>(out_.nodes.size());
    out_.nodes.emplace_back();
    fillNode(slot, source);
    return slot;
  }

  void fillNode(std::uint32_t slot, std::uint32_t source) {
    NarrowNode node{};
    setChild(node, 0, bvh_.nodes[source].left, reference(bvh_.nodes[source].left));
    setChild(node, 1, bvh_.nodes[source].right, reference(bvh_.nodes[source].right));
    out_.nodes[slot] = node;
  }

  const BinaryBvh& bvh_;
  Leaves& leaves_;
  NarrowBvh out_;
};

}  // namespace

WideBvh makeWideBvh(const BinaryBvh& bvh, const CompiledScene& scene) {
  BlockLeaves leaves(bvh, scene);
  WideBvh wide = WideCollapse(bvh, leaves).run();
  wide.blocks = leaves.take();
  return wide;
}

NarrowBvh makeNarrowBvh(const BinaryBvh& bvh, const CompiledScene& scene) {
  TriangleLeaves leaves(bvh, scene);
  NarrowBvh narrow = NarrowCollapse(bvh, leaves).run();
  narrow.triangles = leaves.take();
  return narrow;
}

WideBvh makeWideTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children) {
  GivenLeaves leaves(bvh, children);
  return WideCollapse(bvh, leaves).run();
}

NarrowBvh makeNarrowTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children) {
  GivenLeaves leaves(bvh, children);
  return NarrowCollapse(bvh, leaves).run();
}

}  // namespace prelight
