#include "occluders/occluder_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace prelight {
namespace {

std::vector<glm::dvec3> somePoints(std::size_t count) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> grid(0, 9);  // Many points share coordinates.
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(grid(random), grid(random), 0.1 * grid(random));
  return points;
}

TEST(PointTree, Cheapest_IsThatOfAllPoints) {
  const std::vector<glm::dvec3> points = somePoints(700);
  const PointTree tree(points);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 11.0);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 place(unit(random), unit(random), 0.1 * unit(random));
    const auto costOf = [&](std::uint32_t p) {
      const glm::dvec3 path = points[p] - place;
      return 0.5 * glm::dot(path, path) + 0.3 * (p % 7);
    };
    double least = costOf(5);
    for (std::uint32_t p = 0; p < points.size(); ++p) least = std::min(least, costOf(p));
    const PointTree::Found found = tree.cheapest(place, 0.5, costOf, {5, costOf(5)}, points.size());
    EXPECT_EQ(found.cost, least);
    EXPECT_EQ(costOf(found.point), least);
  }
}

TEST(PointTree, LimitedLook_FindsOneThatIsNear) {
  const std::vector<glm::dvec3> points = somePoints(700);
  const PointTree tree(points);
  const glm::dvec3 place(4.2, 4.2, 0.42);
  std::size_t looks = 0;
  const auto costOf = [&](std::uint32_t p) {
    ++looks;
    return glm::dot(points[p] - place, points[p] - place);
  };
  EXPECT_LT(tree.cheapest(place, 1.0, costOf, {0, 1e30}, 12).cost, 2.0);
  EXPECT_LE(looks, 12u);
}

TEST(PointTree, NothingCheaper_KeepsWhatWasGiven) {
  const PointTree none({});
  EXPECT_EQ(none.cheapest(
                    {}, 1.0, [](std::uint32_t) { return 0.0; }, {42, 1.0}, 9)
                .point,
            42u);
}

}  // namespace
}  // namespace prelight
