#include "gi/irradiance_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace prelight::test {
namespace {

constexpr IrradianceCacheOptions options{0.3, 0.01, 10.0};

/// A record on the plane y = 0 of the irradiance 1 + 0.2 x, 2 - 0.1 z and 3 from surfaces at `distance`.
CachedIrradiance recordOf(float x, float z, float distance) {
  CachedIrradiance record;
  record.position = {x, 0.0f, z};
  record.normal = {0.0f, 1.0f, 0.0f};
  const float e[] = {1.0f + 0.2f * x, 2.0f - 0.1f * z, 3.0f};
  for (int c = 0; c < 3; ++c) record.light.irradiance[c] = e[c];
  record.light.translation[0][0] = 0.2f;
  record.light.translation[1][2] = -0.1f;
  record.light.closeness = 1.0f / distance;
  record.light.nearest = distance;
  return record;
}

const glm::vec3 up(0.0f, 1.0f, 0.0f);

TEST(IrradianceCache, LightThatChangesEvenly_IsExactBetweenRecords) {
  IrradianceCache cache(options);
  cache.add(std::vector{recordOf(0.0f, 0.0f, 5.0f), recordOf(0.7f, 0.2f, 5.0f), recordOf(-0.3f, 0.6f, 4.0f)});
  for (const glm::vec2& p : {glm::vec2(0.1f, 0.1f), glm::vec2(0.5f, 0.3f), glm::vec2(-0.2f, -0.4f)}) {
    const auto found = cache.at({p.x, 0.0f, p.y}, up);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 1.0f + 0.2f * p.x, 1e-6f);
    EXPECT_NEAR(found->y, 2.0f - 0.1f * p.y, 1e-6f);
    EXPECT_NEAR(found->z, 3.0f, 1e-6f);
  }
}

/// A far lamp of vector `light` gives irradiance light . n. Its gradient is n x light, because rotations are
/// n x n'.
TEST(IrradianceCache, TurnedNormals_FollowTheRotationGradient) {
  const glm::vec3 light(0.6f, 0.8f, 0.0f);
  CachedIrradiance record;
  record.normal = up;
  record.light.closeness = 0.1f;
  record.light.nearest = 10.0f;
  const glm::vec3 gradient = glm::cross(up, light);
  for (int c = 0; c < 3; ++c) {
    record.light.irradiance[c] = glm::dot(light, up);
    for (int k = 0; k < 3; ++k) record.light.rotation[c][k] = gradient[k];
  }
  IrradianceCache cache(options);
  cache.add(std::vector{record});
  const float angle = 0.2f;
  const glm::vec3 turned(std::sin(angle), std::cos(angle), 0.0f);
  const auto found = cache.at(glm::vec3(0.0f), turned);
  ASSERT_TRUE(found);
  // The gradient is exact to first order: the rest is 1 - cos(angle) of the irradiance.
  EXPECT_NEAR(found->x, glm::dot(light, turned), 1.01f * (1.0f - std::cos(angle)) * 0.8f);
  EXPECT_GT(found->x - 0.8f, 0.9f * 0.6f * std::sin(angle));
}

TEST(IrradianceCache, RecordsReach_TheErrorsShareOfTheDistanceAndNotOtherSurfaces) {
  IrradianceCache cache(options);
  CachedIrradiance record = recordOf(0.0f, 0.0f, 1.0f);
  cache.add(std::vector{record});
  EXPECT_NEAR(cache.reach(0), 0.3, 1e-6);
  EXPECT_TRUE(cache.covers({0.29f, 0.0f, 0.0f}, up));
  EXPECT_FALSE(cache.covers({0.31f, 0.0f, 0.0f}, up));
  EXPECT_FALSE(cache.covers({0.0f, 0.0f, 0.0f}, -up));
  EXPECT_FALSE(cache.covers({0.1f, -0.1f, 0.0f}, up)) << "a step below";
  EXPECT_FALSE(cache.at({0.31f, 0.0f, 0.0f}, up));
}

TEST(IrradianceCache, SteepGradientsAndNearNeighbours_ShortenTheReach) {
  IrradianceCache cache(options);
  CachedIrradiance steep = recordOf(0.0f, 0.0f, 10.0f);
  steep.light.translation[0][0] = 12.0f;  // The sum is 6, so the light halves within half a metre.
  steep.light.translation[1][2] = 0.0f;
  cache.add(std::vector{steep, recordOf(5.0f, 0.0f, 10.0f), recordOf(6.0f, 0.0f, 0.1f)});
  EXPECT_NEAR(cache.reach(0), 0.3 * 0.5, 1e-6);
  EXPECT_NEAR(cache.reach(2), 0.3 * 0.1, 1e-6);
  EXPECT_NEAR(cache.reach(1), 0.3 * 0.1 + 0.3 * 1.0, 1e-6) << "3 by itself";
}

TEST(IrradianceCache, Records_DoNotReachPastTheNearestSurface) {
  IrradianceCache cache(options);
  CachedIrradiance beside = recordOf(0.0f, 0.0f, 5.0f);
  beside.light.nearest = 0.004f;  // Below the least reach.
  cache.add(std::vector{beside});
  EXPECT_NEAR(cache.reach(0), 0.004, 1e-6);
  EXPECT_TRUE(cache.covers({0.003f, 0.0f, 0.0f}, up));
  EXPECT_FALSE(cache.covers({0.005f, 0.0f, 0.0f}, up));
}

}  // namespace
}  // namespace prelight::test
