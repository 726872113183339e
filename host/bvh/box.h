#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

namespace prelight {

/// An axis-aligned box; a default-constructed one is empty.
struct Box {
  glm::vec3 lower{3.4e38f};
  glm::vec3 upper{-3.4e38f};

  void grow(const glm::vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void grow(const Box& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  /// Returns half of the surface area; 0 for an empty box. In double precision, in which no finite box
  /// overflows.
  double halfArea() const {
    const glm::dvec3 d = glm::max(glm::dvec3(upper) - glm::dvec3(lower), glm::dvec3(0.0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

inline Box unite(Box a, const Box& b) {
  a.grow(b);
  return a;
}

inline Box intersect(const Box& a, const Box& b) {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

}  // namespace prelight
