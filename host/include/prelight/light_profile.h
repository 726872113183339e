#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// How a lamp's intensity varies with direction (EXT_lights_ies), in the lamp's own frame, which shines along
/// -Z. A direction has a height, its angle with `pole`, and a turn about that from `start` towards start x
/// pole. Between neighbouring angles the intensity is bilinear; outside of them it is 0.
struct LightProfile {
  glm::dvec3 pole{0.0, 0.0, -1.0};
  glm::dvec3 start{1.0, 0.0, 0.0};
  std::vector<double> heights;  ///< radians from 0 to pi, ascending, two at least
  std::vector<double> turns;    ///< radians, ascending, two at least, over 2 pi at most
  std::vector<double> values;   ///< [turn][height], W/sr, finite, >= 0

  bool operator==(const LightProfile&) const = default;
};

}  // namespace prelight
