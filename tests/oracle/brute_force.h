#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"

namespace prelight::reference {

/// A hit computed in double precision without an acceleration structure.
struct ExactHit {
  double t = 0.0;
  std::uint32_t triangle = 0;
  double u = 0.0;  ///< weight of vertex 1
  double v = 0.0;  ///< weight of vertex 2
};

/// Returns the nearest intersection at t in [0, tMax] over all triangles except `source`, with the lower
/// index at equal distances. It uses plain Cramer's rule in double precision, which is slow and independent
/// of the kernels' method.
std::optional<ExactHit> closestHit(const CompiledScene& scene, const glm::dvec3& origin,
                                   const glm::dvec3& direction, double tMax, std::uint32_t source);

}  // namespace prelight::reference
