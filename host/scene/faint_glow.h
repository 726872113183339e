#pragma once

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns true when all light in a scene is a mere glow, as of bulbs and displays on a model: emissive
/// triangles that leave most of what the camera sees dark and whose light leaves the scene. Emission that
/// lights a room is no such glow, whatever the camera sees of the room.
bool onlyGlows(const CompiledScene& scene, const Camera& camera);

}  // namespace prelight
