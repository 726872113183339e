#pragma once

#include <vector>

#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Returns the irradiance of a light map, W/m2, in every texel. Texels that no look-up of the scene reads are
/// filled with means of nearby ones, coarser with distance, so that mipmaps and block compression find no
/// black.
Picture irradiancePicture(const LightMap& map);

/// Returns accessibility, clamped to 0..1 as stitching seams may exceed that, filled as in
/// irradiancePicture().
Picture occlusionPicture(const LightMap& map);

/// Fills texels with `filled` false from surrounding ones (pull and push: Gortler, Grzeszczuk, Szeliski and
/// Cohen 1996, The Lumigraph, 4.2). `filled` is [row][column].
void fillEmptyTexels(Picture& picture, const std::vector<bool>& filled);

/// Returns whether look-ups of the scene can read each texel, [row][column].
std::vector<bool> metTexels(const LightMapLayout& layout);

/// Returns a light map for programs that mix any four neighbouring texels, as texture filtering does. Texels
/// whose light would thereby reach across a wall (LightMapLayout::walls) take the darker light of the texel
/// beyond it. Beside a wall thinner than two texels, its bright side becomes darker, too.
LightMap withoutWalls(const LightMap& map);

}  // namespace prelight
