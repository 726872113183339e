#pragma once

#include "base/state_file.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Adds a file's light to a hash: kind, strength, position and direction, but not its name.
void addLight(const Light& light, StateHash& hash);

/// Adds all properties of a material that affect light transport to a hash.
void addMaterial(const CompiledMaterial& material, StateHash& hash);

}  // namespace prelight
