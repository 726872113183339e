#include <gtest/gtest.h>

#include "prelight/bake.h"
#include "prelight/refine.h"
#include "refine/shadowed_floor.h"
#include "scene/gltf/charts.h"
#include "support/devices.h"

namespace prelight {
namespace {

TEST(UnwrappedScene, PrimitivesWithoutCoordinates_GetCharts) {
  const LoadedScene scene = test::shadowedFloor();
  ASSERT_TRUE(makeCharts(scene.scene, scene.compiled, 64).charts.empty());
  const LoadedScene unwrapped = unwrap(scene, 64);
  const Charts charts = makeCharts(unwrapped.scene, unwrapped.compiled, 64);
  EXPECT_EQ(charts.charts.size(), 2u);
  EXPECT_TRUE(charts.leftOut.empty());
  EXPECT_EQ(charts.charts[0].texCoord, 1);
  EXPECT_EQ(charts.charts[0].width, 64);  // the floor is the largest
  EXPECT_EQ(unwrapped.compiled.triangleCount(), scene.compiled.triangleCount());
}

TEST(UnwrappedScene, CoordinatesThatServe_Stay) {
  const LoadedScene once = unwrap(test::shadowedFloor(), 64);
  const LoadedScene twice = unwrap(once, 64);
  EXPECT_EQ(once.document, twice.document);
}

/// The floor's texels below the box are dark, although its vertices are not.
TEST(UnwrappedScene, TransferAtTexels_HasShadows) {
  const LoadedScene scene = unwrap(test::shadowedFloor(), 64);
  const BakeResult baked =
      bake(scene, {.sh = {.order = 2}, .chartTransfer = {.size = 64}, .effort = {.rays = 256}},
           {.device = &test::sharedDevice()});
  ASSERT_TRUE(baked.bake.chartTransfer);
  const ChartTransfer& texels = *baked.bake.chartTransfer;
  const auto row = [&](std::size_t texel) { return texels.maps[0].coefficients[texel * texels.rowLength()]; };
  float least = 1.0f, most = 0.0f;
  for (std::size_t texel = 0; texel < texels.maps[0].texels(); ++texel) {
    least = std::min(least, row(texel));
    most = std::max(most, row(texel));
  }
  const float open = 0.5f * std::sqrt(1.0f / 3.14159265f);  // of band 0
  EXPECT_NEAR(most, open, 0.02f * open);
  EXPECT_LT(least, 0.15f * open);
}

}  // namespace
}  // namespace prelight
