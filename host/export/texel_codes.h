#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// Irradiance in texels of 8 bits, which every browser reads.
enum class TexelCode : std::uint8_t {
  Scaled,  ///< value = scale x rgb, linear: MOZ_lightmap's and three.js'
  Rgbm,    ///< value = scale x (8 a rgb)^2: PlayCanvas'
  Rgbd,    ///< value = scale x rgb^2.2 / a: Babylon.js'
};

/// 0..1 in 8 bits, what is beyond cut off.
std::uint8_t toByte(double value);

struct CodedPicture {
  Image image;         ///< alpha is 255 where the code has none
  float scale = 1.0f;  ///< W/m2
};

/// The scale is the least that holds the largest value. Values are finite and not negative.
CodedPicture encodeTexels(const Picture& picture, TexelCode code);

/// What alpha can divide by, of RGBD.
constexpr double rgbdSteps = 255.0;

/// With a scale that pictures share. What is too bright for it is cut off.
CodedPicture encodeTexels(const Picture& picture, TexelCode code, float scale);

/// What a program gets back.
glm::vec3 decodeTexel(const CodedPicture& coded, TexelCode code, std::size_t texel);

}  // namespace prelight
