#pragma once

#include "prelight/light_map.h"

namespace prelight {

/// Returns a light map for programs that mix any four neighbouring texels, as texture filtering does. Texels
/// whose light would thereby reach across a wall (LightMapLayout::walls) take the darker light of the texel
/// beyond it. Beside a wall thinner than two texels, its bright side becomes darker, too.
LightMap withoutWalls(const LightMap& map);

}  // namespace prelight
