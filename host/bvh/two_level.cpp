#include "bvh/two_level.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "bvh/collapse.h"
#include "bvh/top_down.h"

namespace prelight {

namespace {

using device::DeviceInstance;

/// What the two layouts differ in.
template <typename Bvh>
struct Layout;

template <>
struct Layout<WideBvh> {
  using Node = device::WideNode;
  static constexpr BvhTarget target = BvhTarget::Wide;

  static auto& leaves(WideBvh& bvh) { return bvh.blocks; }
  static WideBvh make(const BinaryBvh& bvh, const CompiledScene& scene) { return makeWideBvh(bvh, scene); }
  static std::uint32_t instance(std::uint32_t index) {
    return PRELIGHT_LEAF_BIT | PRELIGHT_INSTANCE_BIT | index;
  }
  /// Each instance is a child by itself.
  static WideBvh makeTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children) {
    return makeWideTop(collapseToWide(bvh, {.leaf = 1.0, .mostTriangles = 1}, 1), children);
  }
};

template <>
struct Layout<NarrowBvh> {
  using Node = device::NarrowNode;
  static constexpr BvhTarget target = BvhTarget::Narrow;

  static auto& leaves(NarrowBvh& bvh) { return bvh.triangles; }
  static NarrowBvh make(const BinaryBvh& bvh, const CompiledScene& scene) {
    return makeNarrowBvh(bvh, scene);
  }
  static std::uint32_t instance(std::uint32_t index) { return PRELIGHT_LEAF_BIT | index; }
  static NarrowBvh makeTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children) {
    return makeNarrowTop(bvh, children);
  }
};

/// A shape as a scene by itself.
CompiledScene sceneOfShape(const CompiledScene& scene, const CompiledShape& shape) {
  CompiledScene alone;
  alone.positions = shape.positions;
  Box bounds;
  for (const glm::vec3& p : shape.positions) bounds.grow(p);
  alone.boundsMin = bounds.lower;
  alone.boundsMax = bounds.upper;
  for (std::uint32_t t = 0; t < shape.triangleCount; ++t)
    alone.triangles.push_back(scene.triangles[shape.firstTriangle + t] - shape.firstVertex);
  return alone;
}

/// Puts a tree behind what there is. Returns its root.
template <typename Bvh>
std::uint32_t append(Bvh& all, Bvh part) {
  auto& leaves = Layout<Bvh>::leaves(all);
  auto& added = Layout<Bvh>::leaves(part);
  const auto root = static_cast<std::uint32_t>(all.nodes.size());
  const auto firstLeaf = static_cast<std::uint32_t>(leaves.size());
  for (auto& node : part.nodes)
    for (std::uint32_t& child : node.child) child += child & PRELIGHT_LEAF_BIT ? firstLeaf : root;
  all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
  leaves.insert(leaves.end(), added.begin(), added.end());
  return root;
}

Box boxOf(const CompiledScene& scene, const CompiledInstance& instance) {
  Box box;
  for (std::uint32_t v = 0; v < scene.shapes[instance.shape].vertexCount; ++v)
    box.grow(scene.positions[instance.firstVertex + v]);
  return box;
}

/// Boxes of the instances, and of the others behind them.
std::vector<Box> upperBoxes(const CompiledScene& scene, const UpperLevel& upper) {
  std::vector<Box> boxes;
  for (const std::uint32_t i : upper.instances) boxes.push_back(boxOf(scene, scene.instances[i]));
  if (upper.hasOthers) boxes.push_back(upper.others);
  const glm::vec3 most = glm::max(glm::abs(scene.boundsMin), glm::abs(scene.boundsMax));
  const glm::vec3 pad(0x1p-20f * std::max({most.x, most.y, most.z}) + std::numeric_limits<float>::min());
  for (Box& box : boxes) box = {box.lower - pad, box.upper + pad};
  return boxes;
}

}  // namespace

TreeContents divideContents(const CompiledScene& scene, std::span<const std::uint32_t> instances,
                            std::span<const std::uint32_t> triangles) {
  std::vector<std::uint8_t> held(scene.triangleCount(), triangles.empty() ? 1 : 0);
  for (const std::uint32_t t : triangles) held[t] = 1;
  TreeContents contents;
  for (const std::uint32_t i : instances) {
    const CompiledInstance& instance = scene.instances[i];
    const auto first = held.begin() + instance.firstTriangle;
    const auto end = first + scene.shapes[instance.shape].triangleCount;
    if (!std::all_of(first, end, [](std::uint8_t is) { return is != 0; })) continue;
    contents.instances.push_back(i);
    std::fill(first, end, std::uint8_t{0});
  }
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (held[t] != 0) contents.triangles.push_back(t);
  return contents;
}

std::vector<DeviceInstance> instanceRecords(const CompiledScene& scene, const UpperLevel& upper) {
  std::vector<DeviceInstance> records;
  for (std::size_t i = 0; i < upper.instances.size(); ++i) {
    const CompiledInstance& instance = scene.instances[upper.instances[i]];
    const glm::dmat3 toShape = glm::inverse(glm::dmat3(instance.toWorld));
    DeviceInstance record{};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        record.toShape[row][column] = static_cast<float>(toShape[column][row]);
      record.centre[row] = static_cast<float>(instance.toWorld[3][row]);
    }
    record.root = upper.roots[i];
    record.firstTriangle = instance.firstTriangle;
    record.triangleCount = scene.shapes[instance.shape].triangleCount;
    records.push_back(record);
  }
  return records;
}

template <typename Bvh>
Bvh buildUpperLevel(const CompiledScene& scene, const UpperLevel& upper) {
  std::vector<std::uint32_t> children;
  for (std::uint32_t i = 0; i < upper.instances.size(); ++i) children.push_back(Layout<Bvh>::instance(i));
  if (upper.hasOthers) children.push_back(upper.othersRoot);
  const BinaryBvh binary =
      buildOverBoxes(upperBoxes(scene, upper), {.price = LeafPrice::Triangles, .leafSize = 1});
  Bvh top = Layout<Bvh>::makeTop(binary, children);
  top.stackSize += upper.lowerStackSize;
  return top;
}

template <typename Bvh>
TwoLevelBvh<Bvh> buildTwoLevel(const CompiledScene& scene, const TreeContents& contents,
                               const BvhOptions& options) {
  TwoLevelBvh<Bvh> tree;
  UpperLevel& upper = tree.upper;
  upper.instances = contents.instances;
  // A node has two children at least.
  upper.nodeCount = static_cast<std::uint32_t>(contents.instances.size() + 1);
  tree.bvh.nodes.resize(upper.nodeCount);
  const auto add = [&](const CompiledScene& from, const BinaryBvh& binary) {
    Bvh part = Layout<Bvh>::make(binary, from);
    upper.lowerStackSize = std::max(upper.lowerStackSize, part.stackSize);
    return append(tree.bvh, std::move(part));
  };
  BvhOptions own = options;
  own.target = Layout<Bvh>::target;
  own.triangles = {};
  std::map<std::uint32_t, std::uint32_t> rootOf;
  for (const std::uint32_t i : contents.instances) {
    const std::uint32_t shape = scene.instances[i].shape;
    if (!rootOf.contains(shape)) {
      const CompiledScene alone = sceneOfShape(scene, scene.shapes[shape]);
      rootOf[shape] = add(alone, buildBvh(alone, own));
    }
    upper.roots.push_back(rootOf[shape]);
  }
  if (!contents.triangles.empty()) {
    own.triangles = contents.triangles;
    const BinaryBvh binary = buildBvh(scene, own);
    upper.hasOthers = true;
    upper.others = binary.nodes[0].bounds;
    upper.othersRoot = add(scene, binary);
  }
  const Bvh top = buildUpperLevel<Bvh>(scene, upper);
  std::copy(top.nodes.begin(), top.nodes.end(), tree.bvh.nodes.begin());
  tree.bvh.stackSize = top.stackSize;
  tree.instances = instanceRecords(scene, upper);
  return tree;
}

template TwoLevelBvh<WideBvh> buildTwoLevel(const CompiledScene&, const TreeContents&, const BvhOptions&);
template TwoLevelBvh<NarrowBvh> buildTwoLevel(const CompiledScene&, const TreeContents&, const BvhOptions&);
template WideBvh buildUpperLevel(const CompiledScene&, const UpperLevel&);
template NarrowBvh buildUpperLevel(const CompiledScene&, const UpperLevel&);

}  // namespace prelight
