#pragma once

#include <bit>
#include <cstdint>

#include "bvh/box.h"

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

}  // namespace prelight
