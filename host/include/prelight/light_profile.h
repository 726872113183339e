#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Intensity of a lamp by direction (EXT_lights_ies), in the lamp's own frame, which shines along -Z. A
/// direction is given by its height, the angle with `pole`, and its turn about the pole from `start` towards
/// cross(start, pole). Intensity is bilinear between neighbouring angles and 0 outside of them.
struct LightProfile {
  glm::dvec3 pole{0.0, 0.0, -1.0};
  glm::dvec3 start{1.0, 0.0, 0.0};
  std::vector<double> heights;  ///< radians from 0 to pi, ascending, at least two
  std::vector<double> turns;    ///< radians, ascending, at least two, spanning at most 2 pi
  std::vector<double> values;   ///< [turn][height], W/sr, finite, >= 0

  bool operator==(const LightProfile&) const = default;
};

}  // namespace prelight
