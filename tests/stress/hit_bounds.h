#pragma once

#include <cstdint>
#include <string>

#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight::test {

/// Intersection of a ray with the plane of a triangle, in double precision, with bounds of how far single
/// precision may be off. The bounds follow Woop's test operation by operation (hit_bounds.cpp derives them),
/// and hold for divisions rounded to 2.5 ulp, as OpenCL requires.
struct Crossing {
  bool degenerate = true;  ///< Edge-on or without area: only the bounds of t are known.
  double t = 0.0, u = 0.0, v = 0.0;
  double weightError = 1.0;  ///< Error of u, v and 1 - u - v; at most 1.
  double tError = 0.0;
  /// Range of t over the corners. The t of any hit lies in it, widened by tError.
  double tLow = 0.0, tHigh = 0.0;
  double leastWeight() const;

  bool certain() const { return !degenerate && leastWeight() > weightError; }
  bool possible() const { return degenerate || leastWeight() >= -weightError; }
};

Crossing crossingOf(const CompiledScene& scene, std::uint32_t triangle, const device::Ray& ray);

/// Compares the device's answers for a ray with all triangles. The hit must be one that the bounds allow, no
/// certain hit may be nearer or be missed, and the any-hit answer must agree. Returns a description of the
/// error, or nothing.
std::string disagreement(const CompiledScene& scene, const device::Ray& ray, const device::Hit& closest,
                         const device::Hit& any);

}  // namespace prelight::test
