#include "charts/chart_growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace prelight {
namespace {

/// Grows charts over two triangles of one region and group. The second stands upright and shares an edge with
/// the first.
GrownCharts growTwo(const CompiledScene& scene) {
  const SurfaceRegions regions{{0, 0}, {1.0}};
  const std::vector<std::uint32_t> groups{0, 0};
  return growCharts(scene, regions, groups, neighboursOf(scene, groups), 0.0);
}

/// A floor triangle, and an upright triangle of a given height on its first edge, which is 2 m long. `first`
/// is the index of the shared edge in the upright triangle.
CompiledScene floorAndUpright(float height, int first) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {2, 0, 0}, {1, 0, -2}, {1, height, 0}};
  glm::uvec3 upright;
  for (int i = 0; i < 3; ++i) upright[(first + i) % 3] = glm::uvec3(1, 0, 3)[i];
  return test::sceneOf(positions, {{0, 1, 2}, upright});
}

TEST(ChartGrowth, UprightTriangle_HasAChartOfItsOwn) {
  for (int first = 0; first < 3; ++first) {
    const GrownCharts charts = growTwo(floorAndUpright(1.0f, first));
    EXPECT_NE(charts.chartOf[0], charts.chartOf[1]) << first;
  }
}

// The sliver is thinner than a ten-thousandth of its longest side, which is twice as long as the others.
TEST(ChartGrowth, UprightSliver_JoinsWhicheverOfItsEdgesIsTheFirst) {
  for (int first = 0; first < 3; ++first) {
    const GrownCharts charts = growTwo(floorAndUpright(1e-4f, first));
    EXPECT_EQ(charts.chartOf[0], charts.chartOf[1]) << first;
    const GrownCharts wider = growTwo(floorAndUpright(4e-4f, first));
    EXPECT_NE(wider.chartOf[0], wider.chartOf[1]) << first;
  }
}

}  // namespace
}  // namespace prelight
