#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns how far along a ray, in lengths of `direction`, it meets a triangle from either side; negative
/// behind its start (Moeller and Trumbore 1997, in double precision). For a few rays against all triangles,
/// without a tree.
std::optional<double> distanceTo(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& from,
                                 const glm::dvec3& direction);

}  // namespace prelight
