#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh/binary_bvh.h"

/// The elements that the top-down builder sorts: boxes in rows of four floats.

namespace prelight {

/// Four floats that one instruction processes: the vector type of GCC and Clang, because neither vectorises
/// minima and maxima in loops over arrays while floats keep their rules for NaN.
using Lanes = float __attribute__((vector_size(16)));

inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes most(Lanes a, Lanes b) { return a > b ? a : b; }

/// A box whose fourth lane is unused.
struct LaneBox {
  Lanes lower{3.4e38f, 3.4e38f, 3.4e38f, 3.4e38f};
  Lanes upper{-3.4e38f, -3.4e38f, -3.4e38f, -3.4e38f};

  void grow(const LaneBox& b) {
    lower = least(lower, b.lower);
    upper = most(upper, b.upper);
  }
  void growPoint(Lanes p) {
    lower = least(lower, p);
    upper = most(upper, p);
  }
  Box box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
  double halfArea() const { return box().halfArea(); }
};

/// A triangle, or the part of one that a spatial split left on one side.
struct Reference : LaneBox {
  /// Added to indices in the fourth lane, so that they are normal floats: arithmetic on denormal ones takes a
  /// hundred times as long.
  static constexpr std::uint32_t indexBias = 0x40000000u;

  Reference() = default;
  Reference(const Box& b, std::uint32_t triangle) {
    lower = Lanes{b.lower.x, b.lower.y, b.lower.z, std::bit_cast<float>(triangle + indexBias)};
    upper = Lanes{b.upper.x, b.upper.y, b.upper.z, 0.0f};
  }
  std::uint32_t triangle() const {
    return std::bit_cast<std::uint32_t>(static_cast<float>(lower[3])) - indexBias;
  }
  /// Returns the centre; the corners are halved before they are added, so that no finite box overflows.
  Lanes centre() const { return 0.5f * lower + 0.5f * upper; }
};
static_assert(sizeof(Reference) == 32);

/// The price of triangles: the number of blocks that they fill, because they are tested block by block.
class BlockPrice {
 public:
  /// `shift`: blocks have 2^shift triangles.
  explicit BlockPrice(std::uint32_t shift) : shift_(shift), round_((1u << shift) - 1) {}
  double operator()(std::uint32_t triangles) const {
    return static_cast<double>((triangles + round_) >> shift_);
  }

 private:
  std::uint32_t shift_;
  std::uint32_t round_;
};

/// Bounds of a range of references and of their centres.
struct RangeBounds {
  LaneBox bounds;
  LaneBox centres;

  void grow(const Reference& r) {
    bounds.grow(r);
    centres.growPoint(r.centre());
  }
  void grow(const RangeBounds& other) {
    bounds.grow(other.bounds);
    centres.grow(other.centres);
  }
};

/// Equal cells along the three axes of a range's centres.
class BinGrid {
 public:
  BinGrid(const LaneBox& centres, int bins);

  int bins() const { return bins_; }
  /// Returns true when the centres differ along an axis by a divisible amount.
  bool usable(int axis) const { return scale_[axis] > 0.0f; }
  int binOf(const Reference& reference, int axis) const { return static_cast<int>(cellsOf(reference)[axis]); }
  /// Returns the cells along the axes, 0 to bins - 1; NaN is in the last.
  Lanes cellsOf(const Reference& reference) const {
    return least((reference.centre() - origin_) * scale_, last_);
  }

 private:
  int bins_;
  Lanes last_;
  Lanes origin_{};
  Lanes scale_{};
};

/// A plane between two bins: centres of bins below `bin` go left.
struct ObjectSplit {
  int axis = -1;  ///< -1: none
  int bin = 0;
  double cost = std::numeric_limits<double>::infinity();  ///< sum of half area x blocks
  double overlap = 0.0;                                   ///< half area that the boxes of both sides share
};

/// Returns the half area of the intersection of two boxes; 0 when they are apart.
double sharedHalfArea(const LaneBox& a, const LaneBox& b);

/// Boxes and counts of the references whose centres are in each of `bins` cells per axis.
template <std::size_t bins>
class ObjectBins {
 public:
  void add(const BinGrid& grid, std::span<const Reference> references) {
    for (const Reference& reference : references) {
      const Lanes cells = grid.cellsOf(reference);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::size_t>(static_cast<int>(cells[axis]));
        boxes_[axis][cell].grow(reference);
        ++counts_[axis][cell];
      }
    }
  }

  void add(const ObjectBins& other) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t b = 0; b < bins; ++b) {
        boxes_[axis][b].grow(other.boxes_[axis][b]);
        counts_[axis][b] += other.counts_[axis][b];
      }
  }

  ObjectSplit bestSplit(const BinGrid& grid, const BlockPrice& price) const {
    ObjectSplit best;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (grid.usable(static_cast<int>(axis))) sweep(axis, price, best);
    return best;
  }

 private:
  void sweep(std::size_t axis, const BlockPrice& price, ObjectSplit& best) const {
    std::array<LaneBox, bins> rightBoxes;
    std::array<double, bins> rightCosts;
    LaneBox box;
    std::uint32_t right = 0;
    for (std::size_t b = bins - 1; b > 0; --b) {
      box.grow(boxes_[axis][b]);
      right += counts_[axis][b];
      rightBoxes[b] = box;
      rightCosts[b] = price(right) * box.halfArea();
    }
    const std::uint32_t all = right + counts_[axis][0];
    box = LaneBox();
    std::uint32_t left = 0;
    for (std::size_t b = 1; b < bins; ++b) {
      box.grow(boxes_[axis][b - 1]);
      left += counts_[axis][b - 1];
      if (left == 0 || left == all) continue;
      const double cost = price(left) * box.halfArea() + rightCosts[b];
      if (cost < best.cost)
        best = {static_cast<int>(axis), static_cast<int>(b), cost, sharedHalfArea(box, rightBoxes[b])};
    }
  }

  std::array<std::array<LaneBox, bins>, 3> boxes_;
  std::array<std::array<std::uint32_t, bins>, 3> counts_{};
};

}  // namespace prelight
