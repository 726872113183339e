#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "prelight/picture.h"

namespace prelight::test {

/// Gives the texels whose middles lie within an angle (rad) of a unit direction a radiance.
inline void addDisk(Environment& sky, const glm::dvec3& direction, double radius, const glm::vec3& radiance) {
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column)
      if (glm::dot(Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height), direction) >
          std::cos(radius))
        sky.radiance[static_cast<std::size_t>(row) * sky.width + column] = radiance;
}

/// Returns a sky of the same radiance everywhere but in a disk.
inline Environment skyWithDisk(int width, const glm::vec3& around, const glm::dvec3& direction, double radius,
                               const glm::vec3& radiance) {
  const int height = width / 2;
  Environment sky{width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width) * height, around)};
  addDisk(sky, direction, radius, radiance);
  return sky;
}

}  // namespace prelight::test
