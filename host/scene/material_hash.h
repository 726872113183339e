#pragma once

#include "base/state_file.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Adds all properties of a material that affect light transport to a hash.
void addMaterial(const CompiledMaterial& material, StateHash& hash);

}  // namespace prelight
