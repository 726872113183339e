#include "bvh/morton_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "bvh/object_split.h"
#include "bvh/top_down.h"

namespace prelight {

namespace {

constexpr std::size_t grain = 1u << 15;
constexpr int bitsAnAxis = 16;
constexpr int radixBits = 8;

struct Coded {
  std::uint64_t code;
  std::uint32_t triangle;
};

/// Moves bit i of x to bit 3 i.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

/// Codes of the cells of a grid over the centres; an axis along which the centres do not differ has one cell.
class Grid {
 public:
  explicit Grid(const LaneBox& centres) : centres_(centres) {
    for (int axis = 0; axis < 3; ++axis) {
      const double extent =
          static_cast<double>(centres.upper[axis]) - static_cast<double>(centres.lower[axis]);
      scale_[axis] = extent > 0.0 ? static_cast<double>(1 << bitsAnAxis) / extent : 0.0;
    }
  }
  std::uint64_t codeOf(const Reference& reference) const {
    const Lanes centre = reference.centre();
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell =
          (static_cast<double>(centre[axis]) - static_cast<double>(centres_.lower[axis])) * scale_[axis];
      code |= spread(static_cast<std::uint64_t>(std::min(cell, static_cast<double>((1 << bitsAnAxis) - 1))))
              << (2 - axis);
    }
    return code;
  }

 private:
  LaneBox centres_;
  glm::dvec3 scale_{0.0};
};

/// Sorts by code, stably (radix sort, least significant digit first).
void radixSort(std::vector<Coded>& items, std::size_t threads) {
  constexpr std::size_t digits = std::size_t{1} << radixBits;
  std::vector<Coded> sorted(items.size());
  const std::size_t blocks = (items.size() + grain - 1) / grain;
  std::vector<std::array<std::uint32_t, digits>> places(blocks);
  for (int shift = 0; shift < 3 * bitsAnAxis; shift += radixBits) {
    const auto digitOf = [shift](const Coded& item) { return item.code >> shift & (digits - 1); };
    parallelRanges(
        items.size(), grain,
        [&](std::size_t begin, std::size_t end) {
          places[begin / grain] = {};
          for (std::size_t i = begin; i < end; ++i) ++places[begin / grain][digitOf(items[i])];
        },
        threads);
    std::uint32_t place = 0;
    for (std::size_t digit = 0; digit < digits; ++digit)
      for (auto& counts : places) place += std::exchange(counts[digit], place);
    parallelRanges(
        items.size(), grain,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            sorted[places[begin / grain][digitOf(items[i])]++] = items[i];
        },
        threads);
    items.swap(sorted);
  }
}

class MortonBuilder {
 public:
  MortonBuilder(const CompiledScene& scene, std::size_t threads)
      : references_(makeReferences(scene, threads)), threads_(threads) {}

  BinaryBvh build() {
    encode();
    radixSort(items_, threads_);
    const auto count = static_cast<std::uint32_t>(items_.size());
    bitDepth_ = BinaryBvh::maxDepth - static_cast<std::uint32_t>(std::bit_width(count));
    split(0, count, 1);
    bvh_.triangleOrder.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) bvh_.triangleOrder[i] = items_[i].triangle;
    fitBoxes();
    return std::move(bvh_);
  }

 private:
  void encode() {
    std::vector<LaneBox> parts((references_.size() + grain - 1) / grain);
    parallelRanges(
        references_.size(), grain,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) parts[begin / grain].growPoint(references_[i].centre());
        },
        threads_);
    LaneBox centres;
    for (const LaneBox& part : parts) centres.grow(part);
    const Grid grid(centres);
    items_.resize(references_.size());
    parallelRanges(
        references_.size(), grain,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            items_[i] = {grid.codeOf(references_[i]), static_cast<std::uint32_t>(i)};
        },
        threads_);
  }

  /// Returns the first item of the right part of [first, last): where the highest bit that changes is set.
  std::uint32_t middleOf(std::uint32_t first, std::uint32_t last, std::uint32_t level) const {
    const std::uint64_t low = items_[first].code, high = items_[last - 1].code;
    if (low == high || level >= bitDepth_) return first + (last - first) / 2;
    const auto bit = static_cast<int>(std::bit_width(low ^ high)) - 1;
    const auto at = std::partition_point(items_.begin() + first, items_.begin() + last,
                                         [bit](const Coded& item) { return (item.code >> bit & 1u) == 0; });
    return static_cast<std::uint32_t>(at - items_.begin());
  }

  std::uint32_t split(std::uint32_t first, std::uint32_t last, std::uint32_t level) {
    const auto slot = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    if (last - first <= BinaryBvh::maxLeafSize) {
      bvh_.nodes[slot].first = first;
      bvh_.nodes[slot].count = (last - first) & 0x7fffffffu;
      bvh_.depth = std::max(bvh_.depth, level);
      return slot;
    }
    const std::uint32_t middle = middleOf(first, last, level);
    bvh_.nodes[slot].left = split(first, middle, level + 1);
    const std::uint32_t right = split(middle, last, level + 1);
    bvh_.nodes[slot].right = right;
    return slot;
  }

  void fitBoxes() {
    parallelRanges(
        bvh_.nodes.size(), grain,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t n = begin; n < end; ++n) {
            BinaryBvh::Node& node = bvh_.nodes[n];
            LaneBox box;
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
              box.grow(references_[bvh_.triangleOrder[i]]);
            node.bounds = box.box();
          }
        },
        threads_);
    for (std::size_t n = bvh_.nodes.size(); n-- > 0;) {
      BinaryBvh::Node& node = bvh_.nodes[n];
      if (node.count == 0) node.bounds = unite(bvh_.nodes[node.left].bounds, bvh_.nodes[node.right].bounds);
    }
  }

  std::vector<Reference> references_;
  std::size_t threads_;
  std::vector<Coded> items_;
  std::uint32_t bitDepth_ = 0;  ///< deeper ranges are halved by count, which bounds the depth
  BinaryBvh bvh_;
};

}  // namespace

BinaryBvh buildMortonTree(const CompiledScene& scene, std::size_t threads) {
  return MortonBuilder(scene, threads).build();
}

}  // namespace prelight
