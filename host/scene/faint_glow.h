#pragma once

#include "prelight/compiled_scene.h"

namespace prelight {

/// Whether what gives light in a scene is a glow alone, as of bulbs and displays on a model: emissive
/// triangles that leave most of what the camera sees dark, and whose light leaves the scene. What lights
/// a room is none, whatever the camera sees of it.
bool onlyGlows(const CompiledScene& scene, const Camera& camera);

}  // namespace prelight
