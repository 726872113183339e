#pragma once

#include <array>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Returns whether a light map stores directions of light.
inline bool hasDirections(const LightMap& map) { return map.coefficients >= 5; }

/// Names of the four pictures of radianceMaps() by their SH functions.
constexpr std::array<const char*, 4> radianceMapNames = {"sh.l0m0", "sh.l1m-1", "sh.l1m0", "sh.l1m1"};

/// Returns incident radiance in SH of order 2, W/(m2 sr), one picture per function, in every texel as in
/// irradiancePicture().
std::vector<Picture> radianceMaps(const LightMap& map);

/// Returns the mean direction d of light in every texel, weighted by luminance; its length is 1 for light of
/// a single direction. With 8 bits per channel, rgb = (d + 1) / 2 in world space and a = (n.d + 1) / 2 for
/// the surface's normal n, so that a surface with bumped normal m has irradiance E (m.d + 1) / 2 / a: the
/// half Lambert of Unity's directional light maps.
Image directionImage(const CompiledScene& scene, const LightMap& map);

}  // namespace prelight
