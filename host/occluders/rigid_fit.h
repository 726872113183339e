#pragma once

#include <glm/glm.hpp>
#include <span>

#include "occluders/rigid_motion.h"

namespace prelight {

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
