#include "bvh/builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <numeric>

#include "base/parallel.h"

namespace prelight {

namespace {

constexpr int binCount = 32;
constexpr std::uint32_t sahDepth = 40;  // below, halves by count: bounds the depth at 40 + log2(2^27 / 8)
constexpr std::uint32_t parallelSize = 16384;  // smaller ranges are not worth a thread
constexpr float boxCost = 0.4f;                // of a node visit, in units of a triangle block test

struct Split {
  int axis = -1;
  float position = 0.0f;  // centroids below go left
  float cost = 0.0f;
};

float blockCount(std::uint32_t triangles) {
  return static_cast<float>((triangles + BinaryBvh::maxLeafSize - 1) / BinaryBvh::maxLeafSize);
}

class Builder {
 public:
  explicit Builder(const CompiledScene& scene)
      : boxes_(scene.triangleCount()), centroids_(scene.triangleCount()) {
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      for (int corner = 0; corner < 3; ++corner) boxes_[t].grow(scene.positions[scene.triangles[t][corner]]);
      centroids_[t] = 0.5f * boxes_[t].lower + 0.5f * boxes_[t].upper;
    }
    bvh_.triangleOrder.resize(scene.triangleCount());
    std::iota(bvh_.triangleOrder.begin(), bvh_.triangleOrder.end(), 0u);
    bvh_.nodes.resize(2 * std::size_t{scene.triangleCount()});
  }

  BinaryBvh build() {
    int spare = static_cast<int>(std::ceil(std::log2(static_cast<double>(hardwareThreads())))) + 1;
    bvh_.depth = buildRange(0, 0, static_cast<std::uint32_t>(bvh_.triangleOrder.size()), 1, spare);
    return std::move(bvh_);
  }

 private:
  // A range of n triangles owns the 2n - 1 node slots from `slot` on, so that threads never meet.
  std::uint32_t buildRange(std::uint32_t slot, std::uint32_t first, std::uint32_t count, std::uint32_t level,
                           int spareForks) {
    BinaryBvh::Node& node = bvh_.nodes[slot];
    Box centroidBounds;
    for (std::uint32_t i = first; i < first + count; ++i) {
      node.bounds.grow(boxes_[bvh_.triangleOrder[i]]);
      centroidBounds.grow(centroids_[bvh_.triangleOrder[i]]);
    }
    const std::uint32_t middle = partition(node.bounds, centroidBounds, first, count, level);
    if (middle == first) {
      node.first = first;
      node.count = count;
      return level;
    }
    const std::uint32_t leftCount = middle - first;
    node.left = slot + 1;
    node.right = slot + 2 * leftCount;
    const auto buildRight = [=, this] {
      return buildRange(slot + 2 * leftCount, middle, count - leftCount, level + 1, spareForks - 1);
    };
    if (spareForks > 0 && count > parallelSize) {
      auto right = std::async(std::launch::async, buildRight);
      const std::uint32_t left = buildRange(slot + 1, first, leftCount, level + 1, spareForks - 1);
      return std::max(left, right.get());
    }
    return std::max(buildRange(slot + 1, first, leftCount, level + 1, spareForks - 1), buildRight());
  }

  // First triangle of the right part; `first` itself says that the range is a leaf.
  std::uint32_t partition(const Box& bounds, const Box& centroidBounds, std::uint32_t first,
                          std::uint32_t count, std::uint32_t level) {
    const auto begin = bvh_.triangleOrder.begin() + first;
    const auto end = begin + count;
    const Split split = level < sahDepth ? bestSplit(centroidBounds, first, count) : Split{};
    const float leafCost = blockCount(count) * bounds.halfArea();
    const bool splitPays = split.axis >= 0 && split.cost + boxCost * bounds.halfArea() < leafCost;
    if (count <= BinaryBvh::maxLeafSize && !splitPays) return first;
    if (split.axis >= 0) {
      const auto middle = std::partition(
          begin, end, [&](std::uint32_t t) { return centroids_[t][split.axis] < split.position; });
      if (middle != begin && middle != end) return first + static_cast<std::uint32_t>(middle - begin);
    }
    // All centroids in one place, or too deep: halves in the order along the longest axis.
    const glm::vec3 extent = centroidBounds.upper - centroidBounds.lower;
    const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    const auto middle = begin + count / 2;
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      return centroids_[a][axis] != centroids_[b][axis] ? centroids_[a][axis] < centroids_[b][axis] : a < b;
    });
    return first + count / 2;
  }

  Split bestSplit(const Box& centroidBounds, std::uint32_t first, std::uint32_t count) const {
    Split best;
    best.cost = std::numeric_limits<float>::infinity();
    const int bins = count < 64 ? 8 : binCount;
    for (int axis = 0; axis < 3; ++axis) {
      const float origin = centroidBounds.lower[axis];
      const float extent = centroidBounds.upper[axis] - origin;
      if (!(extent > 0.0f) || !std::isfinite(extent)) continue;  // overflows beyond 2^127
      const float scale = static_cast<float>(bins) / extent;
      if (!std::isfinite(scale)) continue;
      std::array<Box, binCount> boxes;
      std::array<std::uint32_t, binCount> counts{};
      for (std::uint32_t i = first; i < first + count; ++i) {
        const std::uint32_t t = bvh_.triangleOrder[i];
        const int bin = std::min(bins - 1, static_cast<int>((centroids_[t][axis] - origin) * scale));
        boxes[static_cast<std::size_t>(bin)].grow(boxes_[t]);
        ++counts[static_cast<std::size_t>(bin)];
      }
      sweep(boxes, counts, bins, axis, origin, extent, best);
    }
    return best.axis >= 0 ? best : Split{};
  }

  static void sweep(const std::array<Box, binCount>& boxes, const std::array<std::uint32_t, binCount>& counts,
                    int bins, int axis, float origin, float extent, Split& best) {
    std::array<float, binCount> rightCost{};
    Box box;
    std::uint32_t total = 0;
    for (int b = bins - 1; b > 0; --b) {
      box.grow(boxes[static_cast<std::size_t>(b)]);
      total += counts[static_cast<std::size_t>(b)];
      rightCost[static_cast<std::size_t>(b)] = total == 0 ? 0.0f : blockCount(total) * box.halfArea();
    }
    const std::uint32_t all = total + counts[0];
    box = Box();
    total = 0;
    for (int b = 1; b < bins; ++b) {
      box.grow(boxes[static_cast<std::size_t>(b - 1)]);
      total += counts[static_cast<std::size_t>(b - 1)];
      if (total == 0 || total == all) continue;
      const float cost = blockCount(total) * box.halfArea() + rightCost[static_cast<std::size_t>(b)];
      if (cost < best.cost)
        best = {axis, origin + extent * static_cast<float>(b) / static_cast<float>(bins), cost};
    }
  }

  std::vector<Box> boxes_;
  std::vector<glm::vec3> centroids_;
  BinaryBvh bvh_;
};

}  // namespace

BinaryBvh buildBvh(const CompiledScene& scene) { return Builder(scene).build(); }

}  // namespace prelight
