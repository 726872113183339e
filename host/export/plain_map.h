#pragma once

#include "prelight/light_map.h"

namespace prelight {

/// A light map for programs that mix any four texels, as textures are filtered: a texel from which light
/// would so reach beyond a wall (LightMapLayout::walls) takes the darker light of the texel there. Beside a
/// wall that is thinner than two texels its own side is darker for it.
LightMap withoutWalls(const LightMap& map);

}  // namespace prelight
