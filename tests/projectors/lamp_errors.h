#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"

namespace prelight::test {

/// What reaches a vertex from a lamp in a unit direction, cosine included; that of the direction is given.
using LampAtVertex = std::function<double(std::uint32_t vertex, const glm::dvec3& way, double cosine)>;

/// Root mean square error of what reaches the middles of random triangles from random directions above them,
/// taken from a vertex of each, against rays.
double errorOfLamps(const CompiledScene& scene, const LampAtVertex& shown);

}  // namespace prelight::test
