#include "charts/irradiance/small_regions.h"

#include <gtest/gtest.h>

#include <vector>

#include "charts/light_map_charts.h"
#include "scene/surface/surface_regions.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

/// A wide floor and a square of 0.04 m2 above it, each with a texel.
struct TwoSquares {
  TwoSquares() {
    scene = ground(1, 4.0f);
    CompiledScene square = ground(1, 0.1f);
    for (glm::vec3& p : square.positions) p.y = 1.0f;
    append(scene, square);
    layout.width = layout.height = 2;
    layout.chartOf.assign(2 * std::size_t{scene.triangleCount()}, LightMapLayout::noChart);
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) layout.chartOf[t] = 0;
    layout.texels = {{0, 0, 0.3f, 0.3f, true}, {3, 2, 0.3f, 0.3f, true}};
  }

  std::vector<float> shares() const {
    return sharesOfRegions(scene, makeSurfaceRegions(scene, usualCreaseAngle).regionOf, layout);
  }

  CompiledScene scene;
  LightMapLayout layout;
};

/// Each of the two texels stands for half of 64.04 m2.
TEST(SmallRegions, RegionWithinATexelOfItsChart_CountsByItsShare) {
  const std::vector<float> shares = TwoSquares().shares();
  EXPECT_EQ(shares[0], 1.0f);
  EXPECT_NEAR(shares[1], 0.04f / 32.02f, 1e-6f);
}

TEST(SmallRegions, RegionOfManyTexels_CountsWhole) {
  TwoSquares squares;
  for (std::uint32_t i = 0; i < 2000; ++i) squares.layout.texels.push_back({1, 0, 0.3f, 0.3f, true});
  EXPECT_EQ(squares.shares()[1], 1.0f);
}

TEST(SmallRegions, RegionThatIsAChart_CountsWhole) {
  TwoSquares squares;
  squares.layout.chartOf[2] = squares.layout.chartOf[3] = 1;
  EXPECT_EQ(squares.shares()[1], 1.0f);
}

}  // namespace
}  // namespace prelight::test
