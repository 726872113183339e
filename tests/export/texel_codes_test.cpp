#include "export/texel_codes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace prelight {
namespace {

/// Returns the value that a program decodes.
glm::vec3 decodeTexel(const CodedPicture& coded, TexelCode code, std::size_t texel) {
  const std::uint8_t* bytes = &coded.image.rgba[4 * texel];
  const glm::dvec3 color = glm::dvec3(bytes[0], bytes[1], bytes[2]) / 255.0;
  const double alpha = bytes[3] / 255.0;
  glm::dvec3 value = color;
  if (code == TexelCode::Rgbm) value = glm::pow(8.0 * alpha * color, glm::dvec3(2.0));
  if (code == TexelCode::Rgbd) value = glm::pow(color, glm::dvec3(2.2)) / alpha;
  return glm::vec3(static_cast<double>(coded.scale) * value);
}

/// Grey and coloured values over five powers of ten.
Picture wideRange() {
  Picture picture{64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const float value = std::pow(10.0f, -3.0f + 5.0f * static_cast<float>(i) / 4095.0f);
    picture.pixels.emplace_back(value, 0.5f * value, 0.1f * value);
  }
  return picture;
}

double largestRelativeError(TexelCode code, double from) {
  const Picture picture = wideRange();
  const CodedPicture coded = encodeTexels(picture, code);
  double worst = 0.0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double expected = picture.pixels[i].x;
    if (expected < from) continue;
    worst = std::max(worst, std::abs(decodeTexel(coded, code, i).x - expected) / expected);
  }
  return worst;
}

TEST(TexelCodes, LargestValue_ComesBack) {
  for (const TexelCode code : {TexelCode::Scaled, TexelCode::Rgbm, TexelCode::Rgbd}) {
    const Picture picture{1, 1, {{7.0f, 7.0f, 7.0f}}};
    const CodedPicture coded = encodeTexels(picture, code);
    EXPECT_NEAR(decodeTexel(coded, code, 0).y, 7.0f, 0.05f);
  }
}

/// A step of 1/255 in the root of a value is 2/255 of the value; the alpha adds as much again.
TEST(TexelCodes, Rgbm_HoldsFourPowersOfTen) { EXPECT_LT(largestRelativeError(TexelCode::Rgbm, 0.1), 0.04); }

TEST(TexelCodes, Rgbd_HoldsThreePowersOfTen) { EXPECT_LT(largestRelativeError(TexelCode::Rgbd, 1.0), 0.04); }

TEST(TexelCodes, Scaled_IsOffByAStep) {
  const Picture picture = wideRange();
  const CodedPicture coded = encodeTexels(picture, TexelCode::Scaled);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    EXPECT_LE(std::abs(decodeTexel(coded, TexelCode::Scaled, i).z - picture.pixels[i].z),
              1.001f * coded.scale / 255.0f);
}

/// Values of a tenth of a step become one step in every tenth texel.
TEST(TexelCodes, Scaled_BelowAStep_IsRightInTheMean) {
  Picture picture{64, 64, std::vector<glm::vec3>(64 * 64, glm::vec3(0.1f / 255.0f))};
  picture.pixels[0] = glm::vec3(1.0f);
  const CodedPicture coded = encodeTexels(picture, TexelCode::Scaled);
  double sum = 0.0;
  for (std::size_t i = 1; i < picture.pixels.size(); ++i) sum += decodeTexel(coded, TexelCode::Scaled, i).x;
  EXPECT_NEAR(255.0 * sum / 4095.0, 0.1, 0.005);
}

TEST(TexelCodes, BlackPicture_IsBlack) {
  for (const TexelCode code : {TexelCode::Scaled, TexelCode::Rgbm, TexelCode::Rgbd}) {
    const CodedPicture coded = encodeTexels({2, 2, std::vector<glm::vec3>(4, glm::vec3(0.0f))}, code);
    EXPECT_EQ(decodeTexel(coded, code, 3), glm::vec3(0.0f));
  }
}

}  // namespace
}  // namespace prelight
