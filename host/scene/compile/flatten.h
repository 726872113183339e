#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Gives a compiled scene the geometry and the lights of its scene as that is posed now: what compileScene()
/// makes of it, but for materials and images, which stay. Vertices keep their order. `origin`: of its
/// coordinates; none: compileScene()'s. Throws as it does, and leaves nothing of use behind then.
void flattenAnew(const Scene& scene, CompiledScene& compiled,
                 const std::optional<glm::dvec3>& origin = std::nullopt);

}  // namespace prelight
