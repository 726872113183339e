#include "bvh/two_level.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "bvh/builder.h"
#include "bvh/top_down.h"

namespace prelight {

namespace {

using device::DeviceInstance;

// Approximate number of parts per instance into which triangles outside instances are divided.
constexpr std::size_t partsPerInstance = 4;

/// The differences between the two layouts.
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
  /// Makes the upper level, in which each instance is a child of its own.
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

/// Returns a shape as a separate scene.
CompiledScene sceneOfShape(const CompiledScene& scene, const CompiledShape& shape) {
  CompiledScene alone;
  alone.positions = shape.positions;
  Box bounds;
  for (const glm::vec3& p : shape.positions) bounds.grow(p);
  alone.boundsMin = bounds.lower;
  alone.boundsMax = bounds.upper;
  for (std::uint32_t t = 0; t < shape.triangleCount; ++t)
    alone.triangles.push_back(scene.triangles[shape.firstTriangle + t] - shape.firstVertex);
  const auto materials = scene.triangleMaterials.begin() + shape.firstTriangle;
  alone.triangleMaterials.assign(materials, materials + shape.triangleCount);
  alone.materials = scene.materials;
  return alone;
}

/// The offsets of child references once a tree is stored behind another one.
struct Shift {
  std::uint32_t node = 0;
  std::uint32_t leaf = 0;

  std::uint32_t of(std::uint32_t child) const { return child + (child & PRELIGHT_LEAF_BIT ? leaf : node); }
};

/// Appends a tree behind the existing ones.
template <typename Bvh>
Shift append(Bvh& all, Bvh part) {
  auto& leaves = Layout<Bvh>::leaves(all);
  auto& added = Layout<Bvh>::leaves(part);
  const Shift shift{static_cast<std::uint32_t>(all.nodes.size()), static_cast<std::uint32_t>(leaves.size())};
  for (auto& node : part.nodes)
    for (std::uint32_t& child : node.child) child = shift.of(child);
  all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
  leaves.insert(leaves.end(), added.begin(), added.end());
  return shift;
}

Box boxOf(const CompiledScene& scene, const CompiledInstance& instance) {
  Box box;
  for (std::uint32_t v = 0; v < scene.shapes[instance.shape].vertexCount; ++v)
    box.grow(scene.positions[instance.firstVertex + v]);
  return box;
}

/// Returns the boxes of the instances, then those of the other parts.
std::vector<Box> upperBoxes(const CompiledScene& scene, const UpperLevel& upper) {
  std::vector<Box> boxes;
  for (const std::uint32_t i : upper.instances) boxes.push_back(boxOf(scene, scene.instances[i]));
  const glm::vec3 most = glm::max(glm::abs(scene.boundsMin), glm::abs(scene.boundsMax));
  const glm::vec3 pad(0x1p-20f * std::max({most.x, most.y, most.z}) + std::numeric_limits<float>::min());
  for (Box& box : boxes) box = {box.lower - pad, box.upper + pad};
  for (const UpperChild& other : upper.others) boxes.push_back(other.box);
  return boxes;
}

UpperChild childOf(const device::WideNode& node, int i) {
  const auto corner = [i](const auto& rows) { return glm::vec3(rows[0][i], rows[1][i], rows[2][i]); };
  return {{corner(node.lower), corner(node.upper)}, node.child[i]};
}

UpperChild childOf(const device::NarrowNode& node, int i) {
  const auto corner = [i](const auto& rows) { return glm::vec3(rows[i][0], rows[i][1], rows[i][2]); };
  return {{corner(node.lower), corner(node.upper)}, node.child[i]};
}

/// Opens the largest nodes into their children until there are `most` parts. Surroundings of instances, such
/// as walls, would otherwise be tested as a whole before or after all instances.
template <typename Bvh>
std::vector<UpperChild> openLargest(const Bvh& bvh, const UpperChild& root, std::size_t most) {
  const auto smaller = [](const UpperChild& a, const UpperChild& b) {
    return a.box.halfArea() < b.box.halfArea();
  };
  std::vector<UpperChild> parts, open{root};
  while (!open.empty() && parts.size() + open.size() < most) {
    std::pop_heap(open.begin(), open.end(), smaller);
    const auto& node = bvh.nodes[open.back().child];
    open.pop_back();
    for (int i = 0; i < static_cast<int>(std::size(node.child)); ++i) {
      const UpperChild child = childOf(node, i);
      if (!glm::all(glm::lessThanEqual(child.box.lower, child.box.upper))) continue;
      if (child.child & PRELIGHT_LEAF_BIT) {
        parts.push_back(child);
      } else {
        open.push_back(child);
        std::push_heap(open.begin(), open.end(), smaller);
      }
    }
  }
  parts.insert(parts.end(), open.begin(), open.end());
  return parts;
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
  for (const UpperChild& other : upper.others) children.push_back(other.child);
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
  BvhOptions own = options;
  own.target = Layout<Bvh>::target;
  Bvh others;
  if (!contents.triangles.empty()) {
    own.triangles = contents.triangles;
    const BinaryBvh binary = buildBvh(scene, own);
    others = Layout<Bvh>::make(binary, scene);
    upper.others =
        openLargest(others, {binary.nodes[0].bounds, 0u}, partsPerInstance * contents.instances.size());
  }
  // A node has at least two children.
  upper.nodeCount = static_cast<std::uint32_t>(contents.instances.size() + upper.others.size() + 1);
  tree.bvh.nodes.resize(upper.nodeCount);
  const auto add = [&](Bvh part) {
    upper.lowerStackSize = std::max(upper.lowerStackSize, part.stackSize);
    return append(tree.bvh, std::move(part));
  };
  const Shift shift = add(std::move(others));
  for (UpperChild& other : upper.others) other.child = shift.of(other.child);
  own.triangles = {};
  std::map<std::uint32_t, std::uint32_t> rootOf;
  for (const std::uint32_t i : contents.instances) {
    const std::uint32_t shape = scene.instances[i].shape;
    if (!rootOf.contains(shape)) {
      const CompiledScene alone = sceneOfShape(scene, scene.shapes[shape]);
      rootOf[shape] = add(Layout<Bvh>::make(buildBvh(alone, own), alone)).node;
    }
    upper.roots.push_back(rootOf[shape]);
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
