#include "benchmarks/suites/relighting/wavelet_turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "benchmarks/suites/relighting/sphere_receivers.h"

namespace prelight::benchmarks {
namespace {

Lit grey(double first, double second) { return {glm::dvec3(first), glm::dvec3(second)}; }

TEST(FlickerMeter, ShownThatFollowsTheExact_DoesNotFlicker) {
  FlickerMeter meter;
  for (const double level : {1.0, 3.0, 2.0}) meter.add(grey(level + 0.5, level - 0.5), grey(level, level), 7);
  EXPECT_EQ(meter.flicker(), 0.0);
  EXPECT_EQ(meter.worst(), 0.0);
  EXPECT_EQ(meter.jump(), 0.0);
  EXPECT_NEAR(meter.error(), std::sqrt(3 * 0.25 / 14.0), 1e-12);
  EXPECT_EQ(meter.coefficients(), 7.0);
}

TEST(FlickerMeter, ShownThatJumps_IsMeasuredAgainstTheExact) {
  FlickerMeter meter;
  meter.add(grey(1.0, 1.0), grey(1.0, 1.0), 1);
  meter.add(grey(1.1, 1.0), grey(1.0, 1.0), 3);
  meter.add(grey(1.1, 1.0), grey(1.0, 1.0), 2);
  EXPECT_NEAR(meter.worst(), 0.1 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(meter.flicker(), 0.1 / 2.0, 1e-12);
  EXPECT_NEAR(meter.jump(), 0.05, 1e-12);
  EXPECT_EQ(meter.coefficients(), 2.0);
}

TEST(SphereReceivers, SkyAndLinks_FillTheHemisphere) {
  const SphereReceivers receivers(40, 6, 3);
  const CubeTexels texels(16);
  const auto links = receivers.links(texels);
  int blocked = 0;
  for (std::size_t v = 0; v < receivers.count(); ++v) {
    const std::vector<float> sky = receivers.texelTransfer(v, texels);
    const double seen = std::accumulate(sky.begin(), sky.end(), 0.0);
    double linked = 0.0;
    for (const haar::Link& link : links[v]) {
      EXPECT_LT(link.sender, receivers.count());
      linked += static_cast<double>(link.weight.x);
    }
    EXPECT_LE(seen, 1.0 + 1e-6);
    // Albedos lie between 0.2 and 0.8.
    EXPECT_GE(linked, 0.2 * (1.0 - seen) - 1e-6) << v;
    EXPECT_LE(linked, 0.8 * (1.0 - seen) + 1e-6) << v;
    if (seen < 0.9) ++blocked;
  }
  EXPECT_GT(blocked, 10);
}

TEST(SphereReceivers, SameSeed_IsTheSameScene) {
  const CubeTexels texels(4);
  EXPECT_EQ(SphereReceivers(10, 4, 1).texelTransfer(7, texels),
            SphereReceivers(10, 4, 1).texelTransfer(7, texels));
  EXPECT_NE(SphereReceivers(10, 4, 1).texelTransfer(7, texels),
            SphereReceivers(10, 4, 2).texelTransfer(7, texels));
}

}  // namespace
}  // namespace prelight::benchmarks
