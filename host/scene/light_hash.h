#pragma once

#include "base/state_file.h"
#include "prelight/scene.h"

namespace prelight {

/// Adds a file's light to a hash: kind, strength, position and direction, but not its name.
void addLight(const Light& light, StateHash& hash);

}  // namespace prelight
