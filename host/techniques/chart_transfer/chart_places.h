#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Where a texel of a map lies on the surface, in scene coordinates.
struct ChartPlace {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< unit, without the normal map
};

/// Places of a map's texels, [row][column]; those off the surface have the mean of their neighbours' places.
std::vector<ChartPlace> placesOf(const ChartTransfer::Map& map, const CompiledScene& scene);

}  // namespace prelight
