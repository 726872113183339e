#include <gtest/gtest.h>

#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr std::size_t middle = 12;  // Middle vertex of a ground of 5 x 5 vertices.

/// A small ground at y = 0 under a practically infinite ceiling at y = 1.
CompiledScene underCeiling() {
  CompiledScene scene = test::ground(4, 0.1f);
  test::append(scene, test::box(1, {-2000.0f, 1.0f, -2000.0f}, {2000.0f, 1.0005f, 2000.0f}, false));
  return scene;
}

float aoOf(const CompiledScene& scene, double nearLimit, double farLimit, double obscurance) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = 1024;
  request.limits.nearest = nearLimit;
  request.limits.farthest = farLimit;
  request.limits.obscurance = obscurance;
  return test::runBake(scene, request).bake.ao[middle];
}

TEST(OcclusionLimits, Far_LeavesOutWhatIsFarther) {
  const CompiledScene scene = underCeiling();
  EXPECT_LT(aoOf(scene, 0.0, 0.0, 0.0), 0.001f);
  EXPECT_EQ(aoOf(scene, 0.0, 0.9, 0.0), 1.0f);
  // The ceiling is within 2 m inside the cone of cosine 1/2. A quarter of the cosine-weighted hemisphere is
  // outside the cone, and open.
  EXPECT_NEAR(aoOf(scene, 0.0, 2.0, 0.0), 0.25f, 0.01f);
}

TEST(OcclusionLimits, Near_LeavesOutWhatIsNearer) {
  const CompiledScene scene = underCeiling();
  // Only hits beyond 2 m occlude: the ceiling within the cone of cosine 1/2 is nearer, and open.
  EXPECT_NEAR(aoOf(scene, 2.0, 0.0, 0.0), 0.75f, 0.02f);
  EXPECT_LT(aoOf(scene, 0.5, 0.0, 0.0), 0.001f);
}

// The ceiling is at distance 1 / cosine. With r = min(d / D, 1) and m = 1 / D, the integral of 2 r cosine
// over cosine is 2 m - m^2.
TEST(OcclusionLimits, Obscurance_IsTheIntegralOfTheFadingDistance) {
  const CompiledScene scene = underCeiling();
  for (const double reach : {1.25, 2.0, 5.0, 20.0}) {
    const double m = 1.0 / reach;
    EXPECT_NEAR(aoOf(scene, 0.0, 0.0, reach), 2.0 * m - m * m, 0.004) << reach;
  }
  EXPECT_EQ(aoOf(scene, 0.0, 0.0, 0.99), 1.0f);
}

TEST(OcclusionLimits, Obscurance_ShadowsTheTransferAlike) {
  const CompiledScene scene = underCeiling();
  BakeRequest request;
  request.ao = true;
  request.sh.order = 2;
  request.haar.size = 4;
  request.haar.error = 0.0;
  request.limits.obscurance = 2.0;
  const Bake bake = test::runBake(scene, request).bake;
  EXPECT_NEAR(bake.sh->coefficients[4 * middle] * std::sqrt(4.0 * 3.14159265), bake.ao[middle], 1e-4);
  double averages = 0.0;
  for (std::uint32_t i = bake.haar->offsets[middle]; i < bake.haar->offsets[middle + 1]; ++i)
    if (bake.haar->indices[i] % 16 == 0) averages += 4.0 * bake.haar->values[i];
  EXPECT_NEAR(averages, bake.ao[middle], 0.01);
}

}  // namespace
}  // namespace prelight
