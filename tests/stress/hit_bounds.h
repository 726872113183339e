#pragma once

#include <cstdint>
#include <string>

#include "prelight/compiled_scene.h"
#include "shared/ray_types.h"

namespace prelight::test {

/// Where a ray meets the plane of a triangle, in double precision, and how far from it single precision may
/// end up. The bounds follow Woop's test operation by operation (hit_bounds.cpp derives them); they hold for
/// divisions rounded to 2.5 ulp, as OpenCL asks.
struct Crossing {
  bool degenerate = true;  ///< edge-on or of no area: nothing is known but the bounds of t
  double t = 0.0, u = 0.0, v = 0.0;
  double weightError = 1.0;  ///< of u, v and 1 - u - v; at most 1
  double tError = 0.0;
  double tLow = 0.0, tHigh = 0.0;  ///< of the corners, tError apart: any hit's t lies between
  double leastWeight() const;

  bool certain() const { return !degenerate && leastWeight() > weightError; }
  bool possible() const { return degenerate || leastWeight() >= -weightError; }
};

Crossing crossingOf(const CompiledScene& scene, std::uint32_t triangle, const device::Ray& ray);

/// Compares the device's answers for a ray with all triangles: the hit must be one that the bounds allow,
/// nothing that is certainly there may be nearer or be missed, and the any-hit answer must agree. Returns
/// what is wrong, or nothing.
std::string disagreement(const CompiledScene& scene, const device::Ray& ray, const device::Hit& closest,
                         const device::Hit& any);

}  // namespace prelight::test
