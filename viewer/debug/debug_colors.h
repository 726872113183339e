#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace prelight::viewer {

/// Returns a saturated colour of a number; numbers that are near one another have hues far apart.
glm::vec3 distinctColor(std::size_t number);

/// Returns the colour of a share: blue at 0, then green, yellow, and red at 1.
glm::vec3 scaleColor(double share);

}  // namespace prelight::viewer
