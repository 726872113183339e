#include "bvh/two_level.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "bvh/top_down.h"
#include "prelight/error.h"

namespace prelight {

namespace {

using device::DeviceInstance;
using device::NarrowNode;

/// Bounds of the transformed corners, rounded to nearest: the padding covers that.
Box worldBox(const Box& box, const glm::dmat4& toWorld) {
  Box result;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                       corner & 4 ? box.upper.z : box.lower.z, 1.0);
    result.grow(glm::vec3(toWorld * p));
  }
  return result;
}

DeviceInstance deviceInstance(const ShapeTrees::Shape& shape, const Instance& instance) {
  const glm::dmat4 toObject = glm::inverse(glm::dmat4(instance.toWorld));
  DeviceInstance d{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const auto value = static_cast<float>(toObject[column][row]);
      if (!std::isfinite(value))
        throw Error(ExitCode::RuntimeFailure,
                    "instance of triangles from " + std::to_string(instance.firstTriangle),
                    "its matrix has no inverse that single precision holds", "scale it by more than 0");
      d.toObject[row][column] = value;
    }
  d.firstNode = shape.firstNode;
  d.firstLeaf = shape.firstLeaf;
  d.firstTriangle = instance.firstTriangle;
  d.triangleCount = shape.triangleCount;
  return d;
}

class TopLayout {
 public:
  explicit TopLayout(const BinaryBvh& bvh) : bvh_(bvh) {}

  std::vector<NarrowNode> run() {
    nodes_.emplace_back();
    const BinaryBvh::Node& root = bvh_.nodes[0];
    if (root.count > 0) {
      // A single instance is the first child; the second's box is inverted.
      setChild(0, 0, 0);
      for (int axis = 0; axis < 3; ++axis) {
        nodes_[0].lower[1][axis] = std::numeric_limits<float>::max();
        nodes_[0].upper[1][axis] = std::numeric_limits<float>::max();
      }
      nodes_[0].child[1] = PRELIGHT_LEAF_BIT;
    } else {
      setChild(0, 0, root.left);
      setChild(0, 1, root.right);
    }
    return std::move(nodes_);
  }

 private:
  void setChild(std::size_t slot, int side, std::uint32_t source) {
    const BinaryBvh::Node& node = bvh_.nodes[source];
    for (int axis = 0; axis < 3; ++axis) {
      nodes_[slot].lower[side][axis] = node.bounds.lower[axis];
      nodes_[slot].upper[side][axis] = node.bounds.upper[axis];
    }
    if (node.count > 0) {
      nodes_[slot].child[side] = PRELIGHT_LEAF_BIT | bvh_.triangleOrder[node.first];
      return;
    }
    const std::size_t child = nodes_.size();
    nodes_.emplace_back();
    nodes_[slot].child[side] = static_cast<std::uint32_t>(child);
    setChild(child, 0, node.left);
    setChild(child, 1, node.right);
  }

  const BinaryBvh& bvh_;
  std::vector<NarrowNode> nodes_;
};

}  // namespace

ShapeTrees buildShapeTrees(std::span<const CompiledScene> shapes) {
  ShapeTrees trees;
  for (const CompiledScene& scene : shapes) {
    const BinaryBvh bvh = buildBvh(scene, {.quality = BuildQuality::High, .target = BvhTarget::Narrow});
    const NarrowBvh layout = makeNarrowBvh(bvh, scene);
    trees.shapes.push_back({static_cast<std::uint32_t>(trees.nodes.size()),
                            static_cast<std::uint32_t>(trees.triangles.size()), scene.triangleCount(),
                            bvh.nodes[0].bounds});
    trees.nodes.insert(trees.nodes.end(), layout.nodes.begin(), layout.nodes.end());
    trees.triangles.insert(trees.triangles.end(), layout.triangles.begin(), layout.triangles.end());
    trees.stackSize = std::max(trees.stackSize, layout.stackSize);
  }
  return trees;
}

InstanceTree buildInstanceTree(const ShapeTrees& shapes, std::span<const Instance> instances) {
  InstanceTree tree;
  std::vector<Box> boxes;
  Box all;
  for (const Instance& instance : instances) {
    if (instance.shape >= shapes.shapes.size())
      throw Error(
          ExitCode::RuntimeFailure, "instance " + std::to_string(boxes.size()),
          "names shape " + std::to_string(instance.shape) + " of " + std::to_string(shapes.shapes.size()));
    const ShapeTrees::Shape& shape = shapes.shapes[instance.shape];
    tree.instances.push_back(deviceInstance(shape, instance));
    boxes.push_back(worldBox(shape.bounds, glm::dmat4(instance.toWorld)));
    all.grow(boxes.back());
  }
  const glm::vec3 most = glm::max(glm::abs(all.lower), glm::abs(all.upper));
  const glm::vec3 pad(0x1p-20f * std::max({most.x, most.y, most.z}) + std::numeric_limits<float>::min());
  for (Box& box : boxes) box = {box.lower - pad, box.upper + pad};
  const BinaryBvh bvh = buildOverBoxes(boxes, {.price = LeafPrice::Triangles, .leafSize = 1});
  tree.nodes = TopLayout(bvh).run();
  tree.stackSize = bvh.depth + 2;
  return tree;
}

}  // namespace prelight
