#pragma once

#include "base/state_file.h"
#include "prelight/scene.h"

namespace prelight {

/// What a light of a file shines, from where and where to; its name is left out.
void addLight(const Light& light, StateHash& hash);

}  // namespace prelight
