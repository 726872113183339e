#include "viewer/cubes/outside_place.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace prelight::viewer {
namespace {

/// A body of `count` triangles from `first` on, with its bounds.
TwoSidedBody bodyOf(const CompiledScene& scene, std::uint32_t first, std::uint32_t count) {
  TwoSidedBody body;
  body.triangles = {{first, count}};
  for (std::uint32_t t = first; t < first + count; ++t)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& p = scene.positions[scene.triangles[t][k]];
      body.lower = glm::min(body.lower, p);
      body.upper = glm::max(body.upper, p);
    }
  return body;
}

/// A ball of radius 1 about `center`, followed by the triangles of a box.
struct BallAndBox {
  CompiledScene scene;
  std::vector<TriangleRange> ball;
  TwoSidedBody box;

  BallAndBox(const glm::vec3& center, const glm::vec3& lower, const glm::vec3& upper, bool inward = false)
      : scene(test::sphere(12, 1.0f, center)) {
    const std::uint32_t count = scene.triangleCount();
    ball = {{0, count}};
    test::append(scene, test::box(2, lower, upper, inward));
    box = bodyOf(scene, count, scene.triangleCount() - count);
  }
};

TEST(OutsidePlace, Within_IsToldWhicheverWayFacesLook) {
  for (const bool inward : {false, true}) {
    const BallAndBox made({0, 0, 0}, {2, 2, 2}, {4, 4, 4}, inward);
    EXPECT_TRUE(liesWithin(made.scene, made.box, {3, 3, 3}));
    EXPECT_TRUE(liesWithin(made.scene, made.box, {2.01f, 3.9f, 2.5f}));
    for (const glm::vec3& p : {glm::vec3(0), glm::vec3(1.9f, 3, 3), glm::vec3(3, 3, 4.1f)})
      EXPECT_FALSE(liesWithin(made.scene, made.box, p));
  }
}

TEST(OutsidePlace, FreeCentre_IsKept) {
  const BallAndBox made({0, 0, 0}, {2, 2, 2}, {4, 4, 4});
  EXPECT_EQ(placeOutside(made.scene, made.ball, {0.1f, 0, 0}, {made.box}), glm::vec3(0.1f, 0, 0));
}

/// The ball is half sunk in a floor: the eye rises above the floor.
TEST(OutsidePlace, SunkBall_IsSeenFromAboveTheFloor) {
  const BallAndBox made({0, -0.1f, 0}, {-5, -2, -5}, {5, 0, 5});
  const glm::vec3 place = placeOutside(made.scene, made.ball, {0, -0.1f, 0}, {made.box});
  EXPECT_GT(place.y, 0.0f);
  EXPECT_LT(glm::length(place - glm::vec3(0, -0.1f, 0)), 1.0f);
}

/// The centre of the part of a ball that sticks out of a post lies inside the post as well: the eye moves to
/// the surface.
TEST(OutsidePlace, BallAroundAPost_IsSeenFromItsSurface) {
  const BallAndBox made({0, 0, 0}, {-0.3f, -3, -0.3f}, {0.3f, 3, 0.3f});
  const glm::vec3 place = placeOutside(made.scene, made.ball, {0, 0, 0}, {made.box});
  EXPECT_FALSE(liesWithin(made.scene, made.box, place));
  EXPECT_NEAR(glm::length(place), 1.0f, 0.05f);
}

TEST(OutsidePlace, BallInARoom_KeepsItsCentre) {
  const BallAndBox made({0, 0, 0}, {-3, -3, -3}, {3, 3, 3});
  EXPECT_EQ(placeOutside(made.scene, made.ball, {0, 0, 0}, {made.box}), glm::vec3(0));
}

}  // namespace
}  // namespace prelight::viewer
