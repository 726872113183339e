#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "bvh/object_split.h"
#include "prelight/compiled_scene.h"

/// Splits that cut triangles (Stich, Friedrich and Dietrich 2009): a reference that crosses the plane becomes
/// two, each with the box of its part.
namespace prelight {

/// A splitting plane; references that it crosses go to both sides.
struct SpatialSplit {
  int axis = -1;  ///< -1: none
  float position = 0.0f;
  double cost = std::numeric_limits<double>::infinity();  ///< sum of half area x blocks
  std::uint32_t leftCount = 0;
  std::uint32_t rightCount = 0;
  LaneBox left;
  LaneBox right;
};

/// Returns the two parts of a reference at a plane that crosses it. Their boxes are rounded outwards, so that
/// together they contain every point of the reference's part of the triangle.
std::pair<Reference, Reference> splitReference(const CompiledScene& scene, const Reference& reference,
                                               int axis, float position);

/// Returns the best of equally spaced planes along the three axes; none where all references would go to both
/// sides of every plane. Many references are processed by `threads` threads, with the same result.
SpatialSplit bestSpatialSplit(const CompiledScene& scene, std::span<const Reference> references,
                              const LaneBox& bounds, const BlockPrice& price, std::size_t threads);

/// Reorders references[0, count) and splits those that cross the plane, as long as that is cheaper than
/// moving them to one side and the span has room. Returns the number of references in the left part, which
/// comes first, and in the right part.
std::pair<std::uint32_t, std::uint32_t> partitionSpatially(const CompiledScene& scene,
                                                           std::span<Reference> references,
                                                           std::uint32_t count, const SpatialSplit& split);

}  // namespace prelight
