#pragma once

#include "base/state_file.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// All that what follows light asks of a material.
void addMaterial(const CompiledMaterial& material, StateHash& hash);

}  // namespace prelight
