#pragma once

#include <vector>

#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Irradiance of a light map, W/m2, in every texel: those that no look-up of the scene meets hold the mean of
/// what is nearest to them, coarser with distance, so that mipmaps and block compression find no black.
Picture irradiancePicture(const LightMap& map);

/// The same of accessibility, 0..1: stitching seams may have put it a little beyond.
Picture occlusionPicture(const LightMap& map);

/// Fills texels without a weight by those around them that have one (pull and push: Gortler, Grzeszczuk,
/// Szeliski and Cohen 1996, The Lumigraph, 4.2). `filled`: [row][column].
void fillEmptyTexels(Picture& picture, const std::vector<bool>& filled);

/// Whether a look-up on the scene can meet a texel: [row][column].
std::vector<bool> metTexels(const LightMapLayout& layout);

}  // namespace prelight
