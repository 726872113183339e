#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Tangents at the corners of triangles whose material needs some, [triangle][corner]: unit, along
/// which the texture's u grows, w +-1 with the bitangent, along which its v falls, w n x t. They are the
/// file's where it has some, else those of M. Mikkelsen's "Simulation of Wrinkled Surfaces Revisited" (2008)
/// of the coordinates of its normal texture, as glTF 2.0 asks for; without one, of those of its anisotropy,
/// of its coat's normals, or of the first set. 0 at the corners of other triangles.
std::vector<glm::vec4> cornerTangents(const CompiledScene& scene);

/// A unit vector across a unit vector.
glm::dvec3 anyPerpendicular(const glm::dvec3& n);

}  // namespace prelight
