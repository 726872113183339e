#include "bvh/spatial_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

constexpr std::size_t binCount = 16;

/// Equally spaced planes within a box; empty axes have none.
class PlaneGrid {
 public:
  explicit PlaneGrid(const LaneBox& bounds) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float extent = bounds.upper[axis] - bounds.lower[axis];
      const float scale = static_cast<float>(binCount) / extent;
      origin_[axis] = bounds.lower[axis];
      step_[axis] = extent / static_cast<float>(binCount);
      usable_[axis] = extent > 0.0f && std::isfinite(extent) && std::isfinite(scale) && step_[axis] > 0.0f;
      scale_[axis] = usable_[axis] ? scale : 0.0f;
    }
  }
  bool usable(std::size_t axis) const { return usable_[axis]; }
  std::size_t binOf(float value, std::size_t axis) const {
    const float cell = (value - origin_[axis]) * scale_[axis];
    return static_cast<std::size_t>(std::clamp(cell, 0.0f, static_cast<float>(binCount - 1)));
  }
  /// Returns the lower plane of a bin.
  float plane(std::size_t bin, std::size_t axis) const {
    return origin_[axis] + step_[axis] * static_cast<float>(bin);
  }

 private:
  Lanes origin_{}, scale_{}, step_{};
  std::array<bool, 3> usable_{};
};

struct SpatialBins {
  std::array<LaneBox, binCount> boxes;
  std::array<std::uint32_t, binCount> entries{};
  std::array<std::uint32_t, binCount> exits{};

  void add(const SpatialBins& other) {
    for (std::size_t b = 0; b < binCount; ++b) {
      boxes[b].grow(other.boxes[b]);
      entries[b] += other.entries[b];
      exits[b] += other.exits[b];
    }
  }
};

/// Returns true for triangles that pass some of the light: a ray must not meet them twice, so they must lie
/// in one leaf.
bool staysWhole(const CompiledScene& scene, const Reference& reference) {
  return dimsShadows(scene.materials[scene.triangleMaterials[reference.triangle()]]);
}

void addChopped(const CompiledScene& scene, const PlaneGrid& grid, std::size_t axis,
                const Reference& reference, SpatialBins& bins) {
  if (staysWhole(scene, reference)) {
    const std::size_t bin = grid.binOf(reference.centre()[axis], axis);
    ++bins.entries[bin];
    ++bins.exits[bin];
    bins.boxes[bin].grow(reference);
    return;
  }
  const std::size_t first = grid.binOf(reference.lower[axis], axis);
  const std::size_t last = grid.binOf(reference.upper[axis], axis);
  ++bins.entries[first];
  ++bins.exits[last];
  Reference rest = reference;
  for (std::size_t bin = first; bin < last; ++bin) {
    const auto [left, right] = splitReference(scene, rest, static_cast<int>(axis), grid.plane(bin + 1, axis));
    bins.boxes[bin].grow(left);
    rest = right;
  }
  bins.boxes[last].grow(rest);
}

void sweep(const SpatialBins& bins, const PlaneGrid& grid, std::size_t axis, std::uint32_t count,
           const BlockPrice& price, SpatialSplit& best) {
  std::array<LaneBox, binCount> rights;
  std::array<std::uint32_t, binCount> rightCounts{};
  LaneBox box;
  std::uint32_t exits = 0;
  for (std::size_t b = binCount - 1; b > 0; --b) {
    box.grow(bins.boxes[b]);
    exits += bins.exits[b];
    rights[b] = box;
    rightCounts[b] = exits;
  }
  box = LaneBox();
  std::uint32_t entries = 0;
  for (std::size_t b = 1; b < binCount; ++b) {
    box.grow(bins.boxes[b - 1]);
    entries += bins.entries[b - 1];
    if (entries == 0 || rightCounts[b] == 0 || entries == count || rightCounts[b] == count) continue;
    const double cost = price(entries) * box.halfArea() + price(rightCounts[b]) * rights[b].halfArea();
    if (cost < best.cost)
      best = {static_cast<int>(axis), grid.plane(b, axis), cost, entries, rightCounts[b], box, rights[b]};
  }
}

float roundDown(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? f : std::nextafter(f, -3.4e38f);
}

float roundUp(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? f : std::nextafter(f, 3.4e38f);
}

/// Returns the bounds of the parts of a triangle's outline on both sides of a plane.
std::pair<Box, Box> clipOutline(const CompiledScene& scene, std::uint32_t triangle, int axis,
                                float position) {
  Box left, right;
  const glm::uvec3 corners = scene.triangles[triangle];
  for (int edge = 0; edge < 3; ++edge) {
    const glm::vec3 from = scene.positions[corners[edge]], to = scene.positions[corners[(edge + 1) % 3]];
    if (from[axis] <= position) left.grow(from);
    if (from[axis] >= position) right.grow(from);
    if (!((from[axis] < position && to[axis] > position) || (from[axis] > position && to[axis] < position)))
      continue;
    const glm::dvec3 a(from), b(to);
    const double t = (static_cast<double>(position) - a[axis]) / (b[axis] - a[axis]);
    const glm::dvec3 p = a + t * (b - a);
    Box crossing{{roundDown(p.x), roundDown(p.y), roundDown(p.z)},
                 {roundUp(p.x), roundUp(p.y), roundUp(p.z)}};
    crossing.lower[axis] = crossing.upper[axis] = position;
    left.grow(crossing);
    right.grow(crossing);
  }
  return {left, right};
}

enum class SplitSide : std::uint8_t { Left, Right, Both };

/// Returns the cheapest option for a reference that crosses the plane: splitting it, or enlarging one side to
/// contain it.
SplitSide cheapestSide(const CompiledScene& scene, const SpatialSplit& split, const Reference& reference) {
  if (staysWhole(scene, reference))
    return reference.centre()[split.axis] < split.position ? SplitSide::Left : SplitSide::Right;
  const double leftArea = split.left.halfArea(), rightArea = split.right.halfArea();
  LaneBox left = split.left, right = split.right;
  left.grow(reference);
  right.grow(reference);
  const double both = leftArea * split.leftCount + rightArea * split.rightCount;
  const double allLeft = left.halfArea() * split.leftCount + rightArea * (split.rightCount - 1);
  const double allRight = leftArea * (split.leftCount - 1) + right.halfArea() * split.rightCount;
  if (both <= allLeft && both <= allRight) return SplitSide::Both;
  return allLeft <= allRight ? SplitSide::Left : SplitSide::Right;
}

}  // namespace

std::pair<Reference, Reference> splitReference(const CompiledScene& scene, const Reference& reference,
                                               int axis, float position) {
  const auto [left, right] = clipOutline(scene, reference.triangle(), axis, position);
  const Box box = reference.box();
  Box leftPart = intersect(left, box), rightPart = intersect(right, box);
  leftPart.upper[axis] = rightPart.lower[axis] = position;
  // Rounding may invert the box of a point or a line.
  const auto repaired = [](Box b) {
    const glm::vec3 lower = glm::min(b.lower, b.upper);
    b.upper = glm::max(b.lower, b.upper);
    b.lower = lower;
    return b;
  };
  return {Reference(repaired(leftPart), reference.triangle()),
          Reference(repaired(rightPart), reference.triangle())};
}

SpatialSplit bestSpatialSplit(const CompiledScene& scene, std::span<const Reference> references,
                              const LaneBox& bounds, const BlockPrice& price, std::size_t threads) {
  constexpr std::size_t grain = 1u << 14;
  const PlaneGrid grid(bounds);
  SpatialSplit best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!grid.usable(axis)) continue;
    const auto add = [&](std::span<const Reference> some, SpatialBins& bins) {
      for (const Reference& reference : some) addChopped(scene, grid, axis, reference, bins);
    };
    SpatialBins bins;
    if (references.size() <= grain) {
      add(references, bins);
    } else {
      std::vector<SpatialBins> parts((references.size() + grain - 1) / grain);
      parallelRanges(
          references.size(), grain,
          [&](std::size_t begin, std::size_t end) {
            add(references.subspan(begin, end - begin), parts[begin / grain]);
          },
          threads);
      for (const SpatialBins& part : parts) bins.add(part);
    }
    sweep(bins, grid, axis, static_cast<std::uint32_t>(references.size()), price, best);
  }
  return best;
}

std::pair<std::uint32_t, std::uint32_t> partitionSpatially(const CompiledScene& scene,
                                                           std::span<Reference> references,
                                                           std::uint32_t count, const SpatialSplit& split) {
  const auto axis = static_cast<std::size_t>(split.axis);
  std::size_t left = 0;       // references[0, left) go left
  std::size_t right = count;  // references[right, end) go right
  std::size_t end = count;
  while (left < right) {
    Reference& reference = references[left];
    SplitSide side = reference.upper[axis] <= split.position   ? SplitSide::Left
                     : reference.lower[axis] >= split.position ? SplitSide::Right
                                                               : cheapestSide(scene, split, reference);
    if (side == SplitSide::Both && end == references.size())
      side = reference.centre()[axis] < split.position ? SplitSide::Left : SplitSide::Right;
    if (side == SplitSide::Right) {
      std::swap(reference, references[--right]);
      continue;
    }
    if (side == SplitSide::Both) {
      const auto [leftPart, rightPart] = splitReference(scene, reference, split.axis, split.position);
      reference = leftPart;
      references[end++] = rightPart;
    }
    ++left;
  }
  return {static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(end - left)};
}

}  // namespace prelight
