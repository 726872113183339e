#include "gi/update/photon_thinning.h"

#include <gtest/gtest.h>

namespace prelight::test {
namespace {

const std::optional<Box> atOrigin = Box{glm::vec3(0.0f), glm::vec3(0.0f)};

std::uint32_t octavesFrom(double distance, std::uint32_t before = 0) {
  return thinningOctaves({2.0, glm::dvec3(0.0, distance, 0.0)}, atOrigin, before);
}

TEST(PhotonThinning, Octaves_FollowTheSquareOfTheDistance) {
  EXPECT_EQ(octavesFrom(0.0), 0u);
  EXPECT_EQ(octavesFrom(2.0), 0u);
  EXPECT_EQ(octavesFrom(4.2), 2u);  // A quarter at twice the distance.
  EXPECT_EQ(octavesFrom(8.2), 4u);  // A sixteenth at four times the distance.
  EXPECT_EQ(octavesFrom(1e9), 4u);
}

TEST(PhotonThinning, EyeBetweenTwoNumbers_KeepsTheOneThatIs) {
  const double edge = 4.0;  // The distance where one halving becomes two.
  EXPECT_EQ(octavesFrom(0.99 * edge, 2), 2u);
  EXPECT_EQ(octavesFrom(1.01 * edge, 1), 1u);
  EXPECT_EQ(octavesFrom(0.9 * edge, 2), 1u);
  EXPECT_EQ(octavesFrom(1.1 * edge, 1), 2u);
}

TEST(PhotonThinning, LampsOfUnknownDistance_AreNotThinned) {
  EXPECT_EQ(thinningOctaves({2.0, std::nullopt}, atOrigin, 0), 0u);
  EXPECT_EQ(thinningOctaves({0.0, glm::dvec3(1000.0)}, atOrigin, 0), 0u);
  // The eye is at an unknown distance.
  EXPECT_EQ(thinningOctaves({2.0, glm::dvec3(1000.0)}, std::nullopt, 0), 0u);
}

TEST(PhotonThinning, EyeWithinALamp_IsNear) {
  const Box large{glm::vec3(-10.0f), glm::vec3(10.0f)};
  EXPECT_EQ(thinningOctaves({1.0, glm::dvec3(9.0, 0.0, -9.0)}, large, 3), 0u);
}

TEST(PhotonThinning, ThinnableNumbers_CanBeHalvedWithoutRest) {
  for (const std::uint32_t photons : {1u, 16u, 17u, 12345u}) {
    EXPECT_GE(thinnable(photons), photons);
    EXPECT_LT(thinnable(photons), photons + 16);
    EXPECT_EQ(thinnable(photons) % (1u << PhotonThinning::mostOctaves), 0u);
  }
}

}  // namespace
}  // namespace prelight::test
