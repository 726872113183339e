#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/tracer.h"
#include "shared/ray_types.h"

namespace prelight {

/// Number of triangles that a ray may pass before the next one counts as an obstacle, whatever it is.
constexpr int mostPassed = 16;

/// Returns the first hit of each ray at a triangle that it does not pass. passes: (number of the ray,
/// triangle)
/// -> bool. A ray that has passed triangles starts at the last of them afterwards, and ends where it did.
template <typename Passes>
std::vector<device::Hit> firstObstacles(Tracer& tracer, std::vector<device::Ray>& rays,
                                        const Passes& passes) {
  std::vector<device::Hit> obstacles(rays.size(), {0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f});
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < rays.size(); ++i) waiting.push_back(i);
  std::vector<device::Ray> left = rays;
  for (int passed = 0; !waiting.empty(); ++passed) {
    const std::vector<device::Hit> hits = tracer.traceClosest(left);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      const std::size_t i = waiting[k];
      if (hits[k].triangle == PRELIGHT_NO_TRIANGLE) continue;
      if (passed == mostPassed || !passes(i, hits[k].triangle)) {
        obstacles[i] = hits[k];
        continue;
      }
      for (int c = 0; c < 3; ++c) {
        rays[i].origin[c] += hits[k].t * rays[i].direction[c];
        rays[i].direction[c] *= 1.0f - hits[k].t;
      }
      rays[i].sourceTriangle = hits[k].triangle;
      left[kept] = rays[i];
      waiting[kept++] = i;
    }
    waiting.resize(kept);
    left.resize(kept);
  }
  return obstacles;
}

}  // namespace prelight
