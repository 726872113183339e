#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"

namespace prelight::reference {

/// A hit found in double precision without any acceleration structure.
struct ExactHit {
  double t = 0.0;
  std::uint32_t triangle = 0;
  double u = 0.0;  ///< weight of vertex 1
  double v = 0.0;  ///< weight of vertex 2
};

/// Nearest intersection at t in [0, tMax] over all triangles but `source`; the lower index where distances
/// are equal. Plain Cramer's rule in double precision: slow, and independent of the kernels' method.
std::optional<ExactHit> closestHit(const CompiledScene& scene, const glm::dvec3& origin,
                                   const glm::dvec3& direction, double tMax, std::uint32_t source);

}  // namespace prelight::reference
