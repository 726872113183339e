#include "gi/update/photon_thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/scenes.h"

namespace prelight {
namespace {

device::Ray rayOf(const glm::vec3& origin, const glm::vec3& direction, float tMax) {
  return {{origin.x, origin.y, origin.z}, 0, {direction.x, direction.y, direction.z}, tMax};
}

// Coordinates of a point are rounded by its largest coordinate, along whichever axis that is.
TEST(MovedBoxes, FarAlongOneAxis_AreWidenedByItsRoundingAlongAll) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 far(0.0f);
    far[axis] = 1000.0f;
    const CompiledScene scene =
        test::sceneOf({far, far + glm::vec3(1, 0, 0), far + glm::vec3(0, 1, 1)}, {{0, 1, 2}});
    const std::vector<std::uint32_t> triangles{0};
    const std::vector<Box> boxes = boxesAround(scene, triangles);
    ASSERT_EQ(boxes.size(), 1u);
    const float rounding = std::nextafter(1000.0f, 2000.0f) - 1000.0f;
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(boxes[0].lower[k], far[k] - rounding) << axis << ' ' << k;
      EXPECT_GT(boxes[0].upper[k], far[k] + 1.0f + rounding) << axis << ' ' << k;
      EXPECT_GT(boxes[0].lower[k], far[k] - 0.1f) << axis << ' ' << k;
    }
  }
}

TEST(MovedBoxes, RunsOfTriangles_HaveABoxEach) {
  const CompiledScene scene =
      test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                    {{0, 1, 2}, {0, 1, 2}, {3, 4, 5}, {3, 4, 5}});
  const std::vector<std::uint32_t> together{0, 1}, apart{1, 3};
  EXPECT_EQ(boxesAround(scene, together).size(), 1u);
  const std::vector<Box> boxes = boxesAround(scene, apart);
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_LT(boxes[0].upper.x, 2.0f);
  EXPECT_GT(boxes[1].lower.x, 4.0f);
}

TEST(MovedBoxes, Ray_MeetsWhatLiesBeforeItsEndAlone) {
  const Box box{{1, -1, -1}, {2, 1, 1}};
  const float endless = std::numeric_limits<float>::max();
  EXPECT_TRUE(mayMeet(rayOf({0, 0, 0}, {1, 0, 0}, endless), box));
  EXPECT_TRUE(mayMeet(rayOf({1.5f, 0, 0}, {0, 0, 1}, 0.1f), box)) << "from inside";
  EXPECT_FALSE(mayMeet(rayOf({0, 0, 0}, {1, 0, 0}, 0.9f), box)) << "ends before it";
  EXPECT_FALSE(mayMeet(rayOf({3, 0, 0}, {1, 0, 0}, endless), box)) << "behind the origin";
  EXPECT_FALSE(mayMeet(rayOf({0, 3, 0}, {1, 0, 0}, endless), box)) << "passes beside it";
}

}  // namespace
}  // namespace prelight
