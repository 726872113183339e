#include "bvh/top_down.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "bvh/object_split.h"
#include "bvh/parallel_partition.h"
#include "bvh/spatial_split.h"

namespace prelight {

namespace {

constexpr std::size_t referencesAtOnce = 1u << 15;  // references per thread and step
constexpr std::uint32_t minSubtree = 1u << 13;      // smaller ranges are not worth a task
constexpr int smallBins = 8, leanBins = 16, fineBins = 32;
constexpr std::uint32_t minSpatial = 32;  // smaller ranges gain nothing by spatial splits, and cost most
constexpr double minOverlap =
    1e-4;  // share of the root's area; with less overlap, spatial splits are not tried (Stich 2009)

/// References [first, first + count), with room up to first + capacity for references that splits add.
struct Range {
  std::size_t first = 0;
  std::uint32_t count = 0;
  std::size_t capacity = 0;
};

struct Halves {
  Range left, right;
};

struct Subtree {
  std::vector<BinaryBvh::Node> nodes;
  std::vector<std::uint32_t> order;
  std::uint32_t depth = 0;
};

int longestAxis(const LaneBox& box) {
  const glm::dvec3 extent = glm::dvec3(box.box().upper) - glm::dvec3(box.box().lower);
  return extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
}

class TopDownBuilder {
 public:
  /// `scene` may be null when nothing is split spatially.
  TopDownBuilder(std::vector<Reference> references, const CompiledScene* scene, const TopDownOptions& options)
      : scene_(scene),
        options_(options),
        references_(std::move(references)),
        price_(options.price == LeafPrice::Blocks ? 3 : 0) {
    const auto count = static_cast<std::uint32_t>(references_.size());
    root_ = {0, count, count + static_cast<std::size_t>(options.splitBudget * count)};
    references_.resize(root_.capacity);
    subtreeSize_ = std::max(minSubtree, count / 64);
    const auto halvings = static_cast<std::uint32_t>(std::bit_width(root_.capacity));
    sahDepth_ = BinaryBvh::maxDepth > halvings ? BinaryBvh::maxDepth - halvings : 1;
  }

  BinaryBvh build() {
    if (root_.capacity > root_.count) rootArea_ = boundsOf(root_).bounds.halfArea();
    buildTop(root_, 1);
    subtrees_.resize(tasks_.size());
    parallelRanges(
        tasks_.size(), 1,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t t = begin; t < end; ++t)
            buildSubtree(tasks_[t].range, tasks_[t].level, subtrees_[t]);
        },
        options_.threads);
    references_ = {};
    return merge();
  }

 private:
  struct Task {
    Range range;
    std::uint32_t level;
  };
  // In a child of a top node: it is the root of a subtree.
  static constexpr std::uint32_t taskBit = 0x80000000u;

  std::span<Reference> used(const Range& range) {
    return std::span(references_).subspan(range.first, range.count);
  }

  /// Splits a large range with all threads until its parts suit one thread each.
  std::uint32_t buildTop(const Range& range, std::uint32_t level) {
    const std::optional<Halves> halves =
        range.count > subtreeSize_ ? divide(range, level, boundsOf(range)) : std::nullopt;
    if (!halves) {
      tasks_.push_back({range, level});
      return taskBit | static_cast<std::uint32_t>(tasks_.size() - 1);
    }
    const auto slot = static_cast<std::uint32_t>(top_.size());
    top_.emplace_back();
    const std::uint32_t left = buildTop(halves->left, level + 1);
    const std::uint32_t right = buildTop(halves->right, level + 1);
    top_[slot].left = left;
    top_[slot].right = right;
    return slot;
  }

  std::uint32_t buildSubtree(const Range& range, std::uint32_t level, Subtree& out) {
    const auto slot = static_cast<std::uint32_t>(out.nodes.size());
    out.nodes.emplace_back();
    const RangeBounds bounds = boundsOf(range);
    out.nodes[slot].bounds = bounds.bounds.box();
    const std::optional<Halves> halves = divide(range, level, bounds);
    if (!halves) {
      out.nodes[slot].first = static_cast<std::uint32_t>(out.order.size());
      out.nodes[slot].count = range.count & 0x7fffffffu;
      for (const Reference& reference : used(range)) out.order.push_back(reference.triangle());
      out.depth = std::max(out.depth, level);
      return slot;
    }
    out.nodes[slot].left = buildSubtree(halves->left, level + 1, out);
    const std::uint32_t right = buildSubtree(halves->right, level + 1, out);
    out.nodes[slot].right = right;
    return slot;
  }

  /// Joins the subtrees below the top nodes, and releases each as soon as it is copied.
  BinaryBvh merge() {
    std::size_t nodes = top_.size(), triangles = 0;
    std::vector<std::uint32_t> roots;
    for (const Subtree& subtree : subtrees_) {
      roots.push_back(static_cast<std::uint32_t>(nodes));
      nodes += subtree.nodes.size();
      triangles += subtree.order.size();
    }
    BinaryBvh bvh;
    bvh.nodes.reserve(nodes);
    bvh.triangleOrder.reserve(triangles);
    const auto resolve = [&](std::uint32_t child) {
      return child & taskBit ? roots[child & ~taskBit] : child;
    };
    for (BinaryBvh::Node node : top_) {
      node.left = resolve(node.left);
      node.right = resolve(node.right);
      bvh.nodes.push_back(node);
    }
    for (Subtree& subtree : subtrees_) {
      append(bvh, subtree);
      subtree = {};
    }
    for (std::size_t n = top_.size(); n-- > 0;) {
      BinaryBvh::Node& node = bvh.nodes[n];
      node.bounds = unite(bvh.nodes[node.left].bounds, bvh.nodes[node.right].bounds);
    }
    return bvh;
  }

  static void append(BinaryBvh& bvh, const Subtree& subtree) {
    const auto firstNode = static_cast<std::uint32_t>(bvh.nodes.size());
    const auto firstTriangle = static_cast<std::uint32_t>(bvh.triangleOrder.size());
    for (BinaryBvh::Node node : subtree.nodes) {
      if (node.count > 0) {
        node.first += firstTriangle;
      } else {
        node.left += firstNode;
        node.right += firstNode;
      }
      bvh.nodes.push_back(node);
    }
    bvh.triangleOrder.insert(bvh.triangleOrder.end(), subtree.order.begin(), subtree.order.end());
    bvh.depth = std::max(bvh.depth, subtree.depth);
  }

  int binsFor(std::uint32_t count) const {
    return count < 64 ? smallBins : options_.fine ? fineBins : leanBins;
  }

  bool isLarge(const Range& range) const { return range.count > subtreeSize_; }

  RangeBounds boundsOf(const Range& range) {
    RangeBounds all;
    const std::span<Reference> references = used(range);
    if (!isLarge(range)) {
      for (const Reference& reference : references) all.grow(reference);
      return all;
    }
    std::vector<RangeBounds> parts((range.count + referencesAtOnce - 1) / referencesAtOnce);
    parallelRanges(
        range.count, referencesAtOnce,
        [&](std::size_t begin, std::size_t end) {
          for (const Reference& r : references.subspan(begin, end - begin))
            parts[begin / referencesAtOnce].grow(r);
        },
        options_.threads);
    for (const RangeBounds& part : parts) all.grow(part);
    return all;
  }

  /// Returns the two parts of a range; none when it should become a leaf.
  std::optional<Halves> divide(const Range& range, std::uint32_t level, const RangeBounds& bounds) {
    if (range.count <= options_.leafSize) return std::nullopt;
    const BinGrid grid(bounds.centres, binsFor(range.count));
    const ObjectSplit object = level < sahDepth_ ? bestObjectSplit(range, grid) : ObjectSplit{};
    const SpatialSplit spatial = level < sahDepth_ ? bestSpatial(range, bounds, object) : SpatialSplit{};
    if (spatial.cost < object.cost) {
      const auto [left, right] = partitionSpatially(
          *scene_, std::span(references_).subspan(range.first, range.capacity), range.count, spatial);
      if (left > 0 && right > 0 && left < range.count && right < range.count)
        return shareRoom(range, left, right);
      // The room was used up: the references were moved but none is lost, so the range is halved.
      return halve({range.first, left + right, range.capacity}, bounds);
    }
    if (object.axis < 0) return halve(range, bounds);
    const auto goesLeft = [&](const Reference& r) { return grid.binOf(r, object.axis) < object.bin; };
    const std::span<Reference> references = used(range);
    const std::size_t left =
        isLarge(range)
            ? parallelPartition(references, goesLeft, options_.threads)
            : static_cast<std::size_t>(std::partition(references.begin(), references.end(), goesLeft) -
                                       references.begin());
    return shareRoom(range, static_cast<std::uint32_t>(left), range.count - static_cast<std::uint32_t>(left));
  }

  ObjectSplit bestObjectSplit(const Range& range, const BinGrid& grid) {
    switch (grid.bins()) {
      case smallBins:
        return bestObjectSplitOf<smallBins>(range, grid);
      case leanBins:
        return bestObjectSplitOf<leanBins>(range, grid);
      default:
        return bestObjectSplitOf<fineBins>(range, grid);
    }
  }

  template <std::size_t binCount>
  ObjectSplit bestObjectSplitOf(const Range& range, const BinGrid& grid) {
    const std::span<Reference> references = used(range);
    ObjectBins<binCount> bins;
    if (!isLarge(range)) {
      bins.add(grid, references);
      return bins.bestSplit(grid, price_);
    }
    std::vector<ObjectBins<binCount>> parts((range.count + referencesAtOnce - 1) / referencesAtOnce);
    parallelRanges(
        range.count, referencesAtOnce,
        [&](std::size_t begin, std::size_t end) {
          parts[begin / referencesAtOnce].add(grid, references.subspan(begin, end - begin));
        },
        options_.threads);
    for (const ObjectBins<binCount>& part : parts) bins.add(part);
    return bins.bestSplit(grid, price_);
  }

  SpatialSplit bestSpatial(const Range& range, const RangeBounds& bounds, const ObjectSplit& object) {
    if (range.capacity == range.count || range.count <= minSpatial) return {};
    if (object.axis >= 0 && !(object.overlap > minOverlap * rootArea_)) return {};
    const SpatialSplit split =
        bestSpatialSplit(*scene_, used(range), bounds.bounds, price_, isLarge(range) ? options_.threads : 1);
    const std::size_t added = std::size_t{split.leftCount} + split.rightCount - range.count;
    return split.axis >= 0 && range.count + added <= range.capacity ? split : SpatialSplit{};
  }

  /// Divides the remaining room between both sides in proportion, and moves the right part to make room
  /// behind the left one.
  Halves shareRoom(const Range& range, std::uint32_t left, std::uint32_t right) {
    const std::size_t room = range.capacity - left - right;
    const std::size_t leftRoom = room * left / (std::size_t{left} + right);
    const auto begin = references_.begin() + static_cast<std::ptrdiff_t>(range.first + left);
    if (leftRoom > 0)
      std::copy_backward(begin, begin + right, begin + right + static_cast<std::ptrdiff_t>(leftRoom));
    return {{range.first, left, left + leftRoom},
            {range.first + left + leftRoom, right, right + room - leftRoom}};
  }

  /// Halves a range in the order along the longest axis, where all centres coincide or the tree is too deep.
  Halves halve(const Range& range, const RangeBounds& bounds) {
    const auto axis = static_cast<std::size_t>(longestAxis(bounds.centres));
    const std::span<Reference> references = used(range);
    const std::uint32_t left = range.count / 2;
    std::nth_element(references.begin(), references.begin() + left, references.end(),
                     [&](const Reference& a, const Reference& b) {
                       const float x = a.centre()[axis], y = b.centre()[axis];
                       return x != y ? x < y : a.triangle() < b.triangle();
                     });
    return shareRoom(range, left, range.count - left);
  }

  const CompiledScene* scene_;
  TopDownOptions options_;
  std::vector<Reference> references_;
  BlockPrice price_;
  Range root_;
  std::uint32_t subtreeSize_ = 0;
  std::uint32_t sahDepth_ = 0;  ///< deeper ranges are halved by count, which bounds the depth
  double rootArea_ = 0.0;
  std::vector<BinaryBvh::Node> top_;
  std::vector<Task> tasks_;
  std::vector<Subtree> subtrees_;
};

}  // namespace

std::vector<Reference> makeReferences(const CompiledScene& scene, std::size_t threads,
                                      std::span<const std::uint32_t> triangles) {
  std::vector<Reference> references(triangles.empty() ? scene.triangleCount() : triangles.size());
  parallelRanges(
      references.size(), referencesAtOnce,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t t = triangles.empty() ? static_cast<std::uint32_t>(i) : triangles[i];
          Box box;
          for (int corner = 0; corner < 3; ++corner) box.grow(scene.positions[scene.triangles[t][corner]]);
          references[i] = Reference(box, t);
        }
      },
      threads);
  return references;
}

BinaryBvh buildTopDown(const CompiledScene& scene, const TopDownOptions& options) {
  return TopDownBuilder(makeReferences(scene, options.threads, options.triangles), &scene, options).build();
}

BinaryBvh buildOverBoxes(std::span<const Box> boxes, const TopDownOptions& options) {
  std::vector<Reference> references;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    references.emplace_back(boxes[i], static_cast<std::uint32_t>(i));
  TopDownOptions withoutSplits = options;
  withoutSplits.splitBudget = 0.0;
  return TopDownBuilder(std::move(references), nullptr, withoutSplits).build();
}

}  // namespace prelight
