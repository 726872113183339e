#pragma once

#include <glm/glm.hpp>
#include <span>

#include "occluders/rigid_motion.h"

namespace prelight {

struct RigidFit {
  RigidMotion motion;
  double deviation = 0.0;  ///< m, the largest distance of a place from where the motion takes it
};

/// The rigid motion that takes places nearest to others, by least squares; as many of both. The same places
/// give the identity, to the bit. Umeyama, "Least-squares estimation of transformation parameters between two
/// point patterns", 1991.
RigidFit fitMotion(std::span<const glm::vec3> from, std::span<const glm::vec3> to);

}  // namespace prelight
