#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Throws Error where a light map does not fit a scene.
void requireLightMap(const LightMap& map, const CompiledScene& scene);

}  // namespace prelight
