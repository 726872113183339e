#pragma once

#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// A point of a relief, with the frame of its texture and the horizon there (Relief::horizonAt()).
struct ReliefPoint {
  glm::dvec3 normal, tangent, bitangent;  ///< unit, without bumps
  const float* horizon = nullptr;
};

/// Transfer that the relief takes from an open point whose bumped normal is given: over directions between
/// the surface and the horizon, (1/pi) integral max(n.w, 0) Y_i. `hidden` has order^2 entries.
void hiddenByRelief(const ReliefPoint& point, const glm::dvec3& bumped, int order, std::span<double> hidden);

}  // namespace prelight
