#include "gi/small_regions.h"

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

  std::vector<glm::vec3> lessened(double spacing) const {
    std::vector<glm::vec3> irradiance(2, glm::vec3(100.0f));
    lessenSmallRegions(scene, makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle)), layout,
                       spacing, irradiance);
    return irradiance;
  }

  CompiledScene scene;
  LightMapLayout layout;
};

TEST(SmallRegions, RegionWithinATexelOfItsChart_CountsByItsShare) {
  const std::vector<glm::vec3> found = TwoSquares().lessened(1.0);
  EXPECT_EQ(found[0], glm::vec3(100.0f));
  EXPECT_NEAR(found[1].x, 4.0f, 1e-3f);
}

TEST(SmallRegions, RegionOfManyTexels_Stays) { EXPECT_EQ(TwoSquares().lessened(0.05)[1], glm::vec3(100.0f)); }

TEST(SmallRegions, RegionThatIsAChart_Stays) {
  TwoSquares squares;
  squares.layout.chartOf[2] = squares.layout.chartOf[3] = 1;
  EXPECT_EQ(squares.lessened(1.0)[1], glm::vec3(100.0f));
}

}  // namespace
}  // namespace prelight::test
