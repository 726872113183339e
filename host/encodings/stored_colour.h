#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// Returns the three numbers of an encoding from `first` on as a colour.
inline glm::vec3 storedColour(std::span<const float> values, std::size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

}  // namespace prelight
