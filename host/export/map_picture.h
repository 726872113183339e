#pragma once

#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Irradiance of a light map, W/m2, in every texel: those that no look-up of the scene meets hold the mean of
/// what is nearest to them, coarser with distance, so that mipmaps and block compression find no black.
Picture irradiancePicture(const LightMap& map);

/// Ambient occlusion of vertices in every texel of a layout, grey.
Picture occlusionPicture(const CompiledScene& scene, const std::vector<float>& ao,
                         const LightMapLayout& layout);

/// Fills texels without a weight by those around them that have one (pull and push: Gortler, Grzeszczuk,
/// Szeliski and Cohen 1996, The Lumigraph, 4.2). `filled`: [row][column].
void fillEmptyTexels(Picture& picture, const std::vector<bool>& filled);

/// Whether a look-up on the scene can meet a texel: [row][column].
std::vector<bool> metTexels(const LightMapLayout& layout);

}  // namespace prelight
