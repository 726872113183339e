#pragma once

#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"

namespace prelight {

/// Returns true when a colour or a radiance is not black.
inline bool shines(const glm::vec3& c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

/// Returns the sky, or nullptr where it is entirely black. `sky` may be nullptr.
const Environment* shiningSky(const Environment* sky);

/// Returns true when any triangle is emissive.
bool hasEmitters(const CompiledScene& scene);

/// Returns true when the scene has a punctual light or an emissive triangle.
bool hasLights(const CompiledScene& scene);

/// Returns true when some surface reflects or transmits light diffusely.
bool scattersDiffusely(const CompiledScene& scene);

}  // namespace prelight
