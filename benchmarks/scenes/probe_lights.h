#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"

/// Positions of lights that cast the compared shadows, in scene coordinates (world minus
/// CompiledScene::origin).
namespace prelight::benchmarks {

/// Returns lights on a spiral that turns three times around the centre of the bounds, at a distance of 0.7 of
/// their diagonal and elevations from 20 to 80 degrees.
std::vector<glm::dvec3> lightsAround(const CompiledScene& scene, std::size_t count);

/// Returns lights spread evenly over the bounds (Halton points), none within a solid or closer to a surface
/// than 2 % of the diagonal; fewer than `count` if the bounds have too little free space. The tracer holds
/// the scene.
std::vector<glm::dvec3> lightsInside(const CompiledScene& scene, Tracer& tracer, std::size_t count);

}  // namespace prelight::benchmarks
