#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::test {

/// A random rotation and a translation by at most `half` along each axis.
glm::dmat4 placedAtRandom(std::mt19937& random, double half);

/// A mesh of one primitive with the shape of a scene of test::sceneOf.
Mesh meshOf(const CompiledScene& shape);

/// Alternating spheres and boxes scattered over a floor. Every fifth one is scaled, every seventh mirrored
/// and stretched. The floor and one box that is drawn once belong to no instance.
Scene strewnScene(std::size_t drawings, double half, std::uint32_t seed);

CompiledScene compiled(const Scene& scene);

}  // namespace prelight::test
