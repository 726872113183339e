#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace prelight {

/// Returns direction number `index` of a spiral of golden angles around a unit axis, with this cosine to it.
/// With evenly spaced cosines the directions are uniform over a cap of the sphere or all of it.
inline glm::dvec3 directionAbout(const glm::dvec3& axis, double cosine, int index) {
  const glm::dvec3 helper = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, axis)), y = glm::cross(axis, x);
  const double across = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double turn = 2.399963229728653 * index + 0.1;
  return cosine * axis + across * (std::cos(turn) * x + std::sin(turn) * y);
}

}  // namespace prelight
