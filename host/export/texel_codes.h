#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Codes of irradiance in 8-bit texels, which every browser reads.
enum class TexelCode : std::uint8_t {
  Scaled,  ///< value = scale x rgb, linear; for MOZ_lightmap and three.js
  Rgbm,    ///< value = scale x (8 a rgb)^2; for PlayCanvas
  Rgbd,    ///< value = scale x rgb^2.2 / a; for Babylon.js
};

/// Returns 0..1 as a byte, clamped.
std::uint8_t toByte(double value);

/// A picture in 8 bits with its scale.
struct CodedPicture {
  Image image;         ///< alpha is 255 where the code has none
  float scale = 1.0f;  ///< W/m2
};

/// Encodes a picture with the least scale that holds the largest value. Values must be finite and not
/// negative.
CodedPicture encodeTexels(const Picture& picture, TexelCode code);

/// Largest factor that the division by an 8-bit alpha gives in RGBD.
constexpr double rgbdSteps = 255.0;

/// Encodes a picture with a given scale, which several pictures may share. Values too bright for it are
/// clamped.
CodedPicture encodeTexels(const Picture& picture, TexelCode code, float scale);

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
