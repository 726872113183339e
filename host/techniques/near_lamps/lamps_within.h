#pragma once

#include <string>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Describes lamps that lie within the bounds of a scene, such as "light 'Lamp'" or "emissive surfaces";
/// empty if there are none, or if the scene is flat, so that nothing lies in front of them.
std::string lampsWithin(const CompiledScene& scene);

}  // namespace prelight
