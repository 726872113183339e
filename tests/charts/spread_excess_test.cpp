#include "charts/irradiance/spread_excess.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace prelight::test {
namespace {

/// A chart that fills a square of texels.
LightMapLayout squareLayout(int side) {
  LightMapLayout layout;
  layout.width = layout.height = side;
  layout.chartOf = {0, 0};
  layout.corners.assign(6, glm::vec2(0.5f));
  for (int i = 0; i < side * side; ++i)
    layout.texels.push_back({static_cast<std::uint32_t>(i), 0, 0.3f, 0.3f, true});
  return layout;
}

float sumOf(const std::vector<glm::vec3>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0f,
                         [](float sum, const glm::vec3& v) { return sum + v.x; });
}

TEST(SpreadExcess, OneTexelOfALargeChart_SharesAllOfIt) {
  const LightMapLayout layout = squareLayout(32);
  std::vector<glm::vec3> excess(layout.texels.size(), glm::vec3(0.0f)),
      irradiance(layout.texels.size(), glm::vec3(1.0f));
  excess[16 * 32 + 16] = glm::vec3(50.0f);
  spreadExcess(layout, excess, irradiance);
  EXPECT_NEAR(sumOf(irradiance), 1024.0f + 50.0f, 1e-2f);
  EXPECT_LT(irradiance[16 * 32 + 16].x, 1.0f + 1.0f);
  EXPECT_GT(irradiance[16 * 32 + 20].x, 1.0f);
  EXPECT_EQ(irradiance[16 * 32 + 26].x, 1.0f);
}

TEST(SpreadExcess, TexelsOfAnotherChart_GetNothing) {
  LightMapLayout layout = squareLayout(16);
  layout.chartOf = {0, 1};
  for (LightMapTexel& texel : layout.texels) texel.face = texel.texel % 16 < 8 ? 0 : 1;
  std::vector<glm::vec3> excess(layout.texels.size(), glm::vec3(0.0f)), irradiance = excess;
  excess[8 * 16 + 7] = glm::vec3(50.0f);
  spreadExcess(layout, excess, irradiance);
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    if (i % 16 >= 8) {
      EXPECT_EQ(irradiance[i].x, 0.0f) << i;
    }
  }
  EXPECT_NEAR(sumOf(irradiance), 50.0f, 1e-3f);
}

TEST(SpreadExcess, TexelWithoutOthers_KeepsASixteenth) {
  const LightMapLayout layout = squareLayout(1);
  const std::vector<glm::vec3> excess(1, glm::vec3(32.0f));
  std::vector<glm::vec3> irradiance(1, glm::vec3(1.0f));
  spreadExcess(layout, excess, irradiance);
  EXPECT_FLOAT_EQ(irradiance[0].x, 3.0f);
}

}  // namespace
}  // namespace prelight::test
