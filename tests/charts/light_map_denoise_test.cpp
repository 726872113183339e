#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "charts/light_map_denoise.h"
#include "denoise/fake_library.h"

namespace prelight {
namespace {

/// Two charts of 6 x 4 texels side by side with one face each, a small chart of 2 x 2 below, and texels
/// without a chart.
LightMap twoCharts(int coefficients) {
  LightMap map;
  LightMapLayout& layout = map.layout;
  layout.width = 14;
  layout.height = 8;
  layout.chartOf = {0, 1, 2};
  layout.chartCount = 3;
  const auto add = [&](std::uint32_t face, int x0, int y0, int width, int height) {
    for (int y = y0; y < y0 + height; ++y)
      for (int x = x0; x < x0 + width; ++x)
        layout.texels.push_back({std::uint32_t(y * layout.width + x), face, 0.3f, 0.3f});
  };
  add(0, 0, 0, 6, 4);
  add(1, 6, 0, 6, 4);
  add(2, 1, 5, 2, 2);
  map.coefficients = coefficients;
  map.values.assign(3 * std::size_t(coefficients) * layout.texelCount(), 0.0f);
  return map;
}

void fill(LightMap& map, std::uint32_t face, float light) {
  for (const LightMapTexel& texel : map.layout.texels)
    for (int i = 0; i < 3 * map.coefficients; ++i)
      if (texel.face == face)
        map.values[std::size_t(texel.texel) * 3 * std::size_t(map.coefficients) + std::size_t(i)] = light;
}

LightMap denoised(LightMap map) {
  const test::UsedLibrary library(FAKE_OIDN);
  Denoiser denoiser;
  denoiseLightMap(denoiser, Progress(), map);
  return map;
}

std::vector<float> valuesOf(const LightMap& map, std::uint32_t face) {
  std::vector<float> values;
  for (const LightMapTexel& texel : map.layout.texels)
    if (texel.face == face) values.push_back(map.values[3 * std::size_t(texel.texel)]);
  return values;
}

TEST(DenoisedLightMap, EvenCharts_StayAsTheyAreUpToTheirBorders) {
  LightMap map = twoCharts(1);
  fill(map, 0, 1.0f);
  fill(map, 1, 64.0f);
  fill(map, 2, 5.0f);
  EXPECT_EQ(denoised(map).values, map.values);
}

TEST(DenoisedLightMap, Chart_SeesNothingOfAnother) {
  LightMap map = twoCharts(1);
  fill(map, 0, 1.0f);
  map.values[3 * 16] = 10.0f;  // A bright texel of the first chart.
  const std::vector<float> beside = valuesOf(denoised(map), 0);
  EXPECT_NE(beside, valuesOf(map, 0)) << "nothing was filtered";
  fill(map, 1, 1000.0f);
  EXPECT_EQ(valuesOf(denoised(map), 0), beside);
}

TEST(DenoisedLightMap, TexelsOfNoChart_StayBlack) {
  LightMap map = twoCharts(1);
  fill(map, 0, 1.0f);
  fill(map, 1, 2.0f);
  std::set<std::uint32_t> used;
  for (const LightMapTexel& texel : map.layout.texels) used.insert(texel.texel);
  const LightMap clean = denoised(map);
  for (std::uint32_t texel = 0; texel < clean.layout.texelCount(); ++texel)
    EXPECT_TRUE(used.count(texel) > 0 || clean.values[3 * std::size_t(texel)] == 0.0f) << texel;
}

/// Averages of the directional coefficients do not depend on how bright the light is.
TEST(DenoisedLightMap, Directions_AreFilteredApartFromBrightness) {
  LightMap map = twoCharts(5);  // Irradiance, and SH of order 2.
  for (const LightMapTexel& texel : map.layout.texels) {
    const bool bright = (texel.texel % 14) % 2 == 0;
    for (std::size_t c = 0; c < 3; ++c) {
      float* values = &map.values[(3 * std::size_t(texel.texel) + c) * 5];
      values[0] = values[1] = bright ? 9.0f : 1.0f;
      values[2] = 0.5f * values[1];
      values[4] = -0.25f * values[1];
    }
  }
  const LightMap clean = denoised(map);
  const float* values = &clean.values[3 * 5 * std::size_t{14 + 3}];
  EXPECT_NE(values[1], 9.0f);
  EXPECT_NE(values[1], 1.0f);
  EXPECT_NEAR(values[2], 0.5f * values[1], 1e-5f);
  EXPECT_EQ(values[3], 0.0f);
  EXPECT_NEAR(values[4], -0.25f * values[1], 1e-5f);
  EXPECT_THAT(test::logOf(FAKE_OIDN), ::testing::HasSubstr("filter directional 1"));
}

}  // namespace
}  // namespace prelight
