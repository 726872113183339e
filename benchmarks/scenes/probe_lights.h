#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"

/// Where lights stand that shadows are judged by; scene coordinates (world minus CompiledScene::origin).
namespace prelight::benchmarks {

/// Lights on a spiral around the centre of the bounds, 0.7 of their diagonal away, at 20 to 80 degrees of
/// elevation, three times around.
std::vector<glm::dvec3> lightsAround(const CompiledScene& scene, std::size_t count);

/// Lights spread evenly over the bounds (Halton points), none within a solid or closer to a surface than 2 %
/// of the diagonal. Fewer where the bounds have no such room. The tracer is of the scene.
std::vector<glm::dvec3> lightsInside(const CompiledScene& scene, Tracer& tracer, std::size_t count);

}  // namespace prelight::benchmarks
