#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns the area of an instance of a primitive in the current pose, m2.
double instanceArea(const CompiledScene& compiled, const PrimitiveRange& range);

/// Returns the linear part of the transform to world space of a mesh's largest instance: the one that
/// stretches an axis most. A skin scales all lengths alike, by the root of the ratio of areas in the current
/// pose. None if nothing draws the mesh.
std::optional<glm::dmat3> largestInstance(const Scene& scene, const CompiledScene& compiled,
                                          std::size_t mesh);

}  // namespace prelight
