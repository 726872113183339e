#pragma once

#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"

namespace prelight {

/// Whether a colour or a radiance is any light at all.
inline bool shines(const glm::vec3& c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

/// The sky, or nullptr where it is black all over: then it is as good as none. `sky` may be nullptr.
const Environment* shiningSky(const Environment* sky);

/// Whether any triangle is emissive.
bool hasEmitters(const CompiledScene& scene);

/// Whether anything in the scene gives light: a punctual light or an emissive triangle.
bool hasLights(const CompiledScene& scene);

/// Whether light that arrives at some surface leaves it again diffusely, on either side.
bool scattersDiffusely(const CompiledScene& scene);

}  // namespace prelight
