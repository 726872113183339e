#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"

namespace prelight::test {

/// Shown light of a lamp of unit intensity in direction `way` at a vertex, cosine included. `cosine` is that
/// of the direction.
using LampAtVertex = std::function<double(std::uint32_t vertex, const glm::dvec3& way, double cosine)>;

/// Root mean square error of lamp light at the middles of random triangles from random directions above them,
/// read from one vertex of each triangle and compared with rays.
double errorOfLamps(const CompiledScene& scene, const LampAtVertex& shown);

}  // namespace prelight::test
