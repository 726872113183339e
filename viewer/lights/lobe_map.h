#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/picture.h"

namespace prelight::viewer {

/// A sky through lobes of the spreads 1/3 (alpha 1), 1/6, 1/12, ... (basis/sky_lobes.h), as skyInLobe() of
/// shaders/sky.glsl looks it up: a texture whose mip levels hold two lobes each, the narrower one in the
/// upper half.
struct LobeMap {
  static constexpr int lobes = 8;
  static constexpr int width = 256;  ///< texels along each side of the first level

  std::vector<std::vector<glm::vec3>> levels;  ///< [level][row][column], each half as wide as the last
};

LobeMap makeLobeMap(const Environment& sky);

}  // namespace prelight::viewer
