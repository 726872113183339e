#pragma once

#include <cstdint>
#include <vector>

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

/// Returns the value that a program decodes.
glm::vec3 decodeTexel(const CodedPicture& coded, TexelCode code, std::size_t texel);

}  // namespace prelight
