#pragma once

#include <array>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Whether a light map tells the directions of its light.
inline bool hasDirections(const LightMap& map) { return map.coefficients >= 5; }

/// What the four pictures of radianceMaps() are called, and the numbers that they hold.
constexpr std::array<const char*, 4> radianceMapNames = {"sh.l0m0", "sh.l1m-1", "sh.l1m0", "sh.l1m1"};

/// Incident radiance in SH of order 2, a picture a function, W/(m2 sr), in every texel (irradiancePicture).
std::vector<Picture> radianceMaps(const LightMap& map);

/// The dominant direction d of light in every texel, as long as light is of one direction: the mean of its
/// directions, weighed by luminance. 8 bits: rgb = (d + 1) / 2 in world space, a = (n.d + 1) / 2 with the
/// surface's normal n, so that a bumped surface has E (m.d + 1) / 2 / a: the half Lambert of Unity's
/// directional light maps.
Image directionImage(const CompiledScene& scene, const LightMap& map);

}  // namespace prelight
