#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Maps a point p of the world to rotation p + translation.
struct RigidMotion {
  glm::dmat3 rotation{1.0};  ///< orthonormal, with determinant 1
  glm::dvec3 translation{0.0};

  glm::dvec3 point(const glm::dvec3& p) const { return rotation * p + translation; }
  glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
  /// Returns where a point that is at p after the motion was before.
  glm::dvec3 pointBefore(const glm::dvec3& p) const { return glm::transpose(rotation) * (p - translation); }

  bool operator==(const RigidMotion&) const = default;
};

}  // namespace prelight
