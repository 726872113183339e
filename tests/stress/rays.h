#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "shared/ray_types.h"

namespace prelight::test {

/// Random numbers that are functions of a counter, so that rays are the same on every thread.
class Counter {
 public:
  explicit Counter(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull) {}

  std::uint64_t bits();
  std::uint64_t below(std::uint64_t count) { return bits() % count; }
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }  ///< Uniform in [0, 1).
  float between(float low, float high) { return low + (high - low) * uniform(); }
  glm::vec3 direction();  ///< Uniform on the sphere.

 private:
  std::uint64_t state_;
};

device::Ray makeRay(const glm::vec3& origin, const glm::vec3& direction,
                    float tMax = std::numeric_limits<float>::infinity(),
                    std::uint32_t source = PRELIGHT_NO_TRIANGLE);

/// Value of the environment variable PRELIGHT_STRESS_RAYS, or else `usual`. Throws UsageError if it is not a
/// count.
std::uint64_t stressRays(std::uint64_t usual);

}  // namespace prelight::test
