#pragma once

#include <glm/glm.hpp>
#include <span>

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

/// A rigid motion fitted to points.
struct RigidFit {
  RigidMotion motion;
  double deviation = 0.0;  ///< m, largest distance of a place from its moved counterpart
};

/// Returns the rigid motion that brings places `from` closest to `to` in the least-squares sense; both have
/// equal length. Equal places give exactly the identity. Umeyama, "Least-squares estimation of transformation
/// parameters between two point patterns", 1991.
RigidFit fitMotion(std::span<const glm::vec3> from, std::span<const glm::vec3> to);

}  // namespace prelight
