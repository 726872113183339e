#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns [triangle][corner] the tangents of triangles whose material needs them: unit, in the direction in
/// which the texture's u grows, with w +-1 such that w n x t is the bitangent, in the direction in which v
/// falls. They are the file's where it has some, otherwise those of M. Mikkelsen's "Simulation of Wrinkled
/// Surfaces Revisited" (2008) for the coordinates of the normal texture, as glTF 2.0 requires; without one,
/// of the anisotropy texture, of the coat's normal texture, or of the first set. 0 at the corners of other
/// triangles.
std::vector<glm::vec4> cornerTangents(const CompiledScene& scene);

/// Returns a unit vector perpendicular to a unit vector.
glm::dvec3 anyPerpendicular(const glm::dvec3& n);

}  // namespace prelight
