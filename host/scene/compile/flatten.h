#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Replaces the geometry and lights of a compiled scene by those of the scene's current pose, as
/// compileScene() computes them. Materials and images stay, and vertices keep their order. `origin`: of the
/// coordinates; none: that of compileScene(). Throws as compileScene() does, after which the compiled scene
/// is unusable.
void flattenAnew(const Scene& scene, CompiledScene& compiled,
                 const std::optional<glm::dvec3>& origin = std::nullopt);

}  // namespace prelight
