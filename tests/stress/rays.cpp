#include "stress/rays.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "prelight/error.h"

namespace prelight::test {

// SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t Counter::bits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

glm::vec3 Counter::direction() {
  const float z = between(-1.0f, 1.0f), phi = between(0.0f, 6.2831853f);
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

device::Ray makeRay(const glm::vec3& origin, const glm::vec3& direction, float tMax, std::uint32_t source) {
  return {{origin.x, origin.y, origin.z}, source, {direction.x, direction.y, direction.z}, tMax};
}

std::uint64_t stressRays(std::uint64_t usual) {
  const char* text = std::getenv("PRELIGHT_STRESS_RAYS");
  if (text == nullptr || *text == '\0') return usual;
  std::uint64_t count = 0;
  const char* end = text + std::strlen(text);
  if (std::from_chars(text, end, count).ptr != end || count == 0)
    throw UsageError("PRELIGHT_STRESS_RAYS", std::string("expected a count of rays, got \"") + text + "\"");
  return count;
}

}  // namespace prelight::test
