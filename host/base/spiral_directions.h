#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace prelight {

/// Returns unit directions distributed evenly over the sphere, from +Z to -Z: a spiral whose steps turn by
/// the golden angle.
inline std::vector<glm::dvec3> spiralDirections(int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    directions.emplace_back(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace prelight
