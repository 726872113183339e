// Places of texels that leave hollows in which nobody sees them.
#include "charts/irradiance/hollows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "charts/layout_places.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

constexpr float half = 0.15f;  // m, of the box; texels are about a metre wide

/// A floor of 8 x 8 m; its map is laid out before a box is put over one of its texels.
struct CoveredFloor {
  CompiledScene scene = ground(1, 4.0f);
  LightMapLayout layout = layoutOf(scene, 1.0);
  std::size_t covered = 0;  ///< index of a texel
  glm::dvec3 place{0.0};    ///< of that texel

  CoveredFloor(float boxHalf) {
    const auto distance = [&](const LightMapTexel& texel) { return glm::length(positionOf(scene, texel)); };
    const auto nearest = std::ranges::min_element(layout.texels, {}, distance);
    covered = static_cast<std::size_t>(nearest - layout.texels.begin());
    place = positionOf(scene, *nearest);
    const glm::vec3 middle(place);
    append(scene, box(1, middle - boxHalf, middle + boxHalf, false));
    // Faces of the scene are numbered anew.
    const std::uint32_t before = 2, after = scene.triangleCount();
    std::vector<std::uint32_t> charts(2 * std::size_t{after}, LightMapLayout::noChart);
    std::copy_n(layout.chartOf.begin(), before, charts.begin());
    layout.chartOf = charts;
    layout.corners.resize(3 * charts.size(), glm::vec2(0.0f));
  }

  std::vector<LightMapTexel> moved(std::span<const std::uint8_t> ignored = {}) const {
    Tracer tracer(scene, sharedDevice());
    LightMapLayout result = layout;
    leaveHollows(scene, tracer, result, ignored);
    return result.texels;
  }
};

double besideOf(const glm::dvec3& place, const glm::dvec3& middle) {
  return std::max(std::abs(place.x - middle.x), std::abs(place.z - middle.z));
}

TEST(LeaveHollows, PlaceWithinASmallBox_MovesBesideIt_AndAllOthersStay) {
  const CoveredFloor floor(half);
  const std::vector<LightMapTexel> moved = floor.moved();
  ASSERT_EQ(moved.size(), floor.layout.texels.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const LightMapTexel& before = floor.layout.texels[i];
    EXPECT_EQ(moved[i].texel, before.texel);
    if (i != floor.covered) {
      EXPECT_EQ(moved[i].face, before.face) << i;
      EXPECT_EQ(moved[i].b1, before.b1) << i;
      EXPECT_EQ(moved[i].b2, before.b2) << i;
    }
  }
  const double beside = besideOf(positionOf(floor.scene, moved[floor.covered]), floor.place);
  EXPECT_GT(beside, double(half));
  EXPECT_LT(beside, 0.5);  // within its square
}

/// Triangles that will move make no hollows, so that places do not depend on where they stand.
TEST(LeaveHollows, PlaceWithinABoxThatMoves_Stays) {
  const CoveredFloor floor(half);
  std::vector<std::uint8_t> moves(floor.scene.triangleCount(), 1);
  moves[0] = moves[1] = 0;  // the floor
  const LightMapTexel moved = floor.moved(moves)[floor.covered];
  EXPECT_EQ(positionOf(floor.scene, moved), floor.place);
  std::fill(moves.begin(), moves.end(), std::uint8_t{0});
  EXPECT_NE(positionOf(floor.scene, floor.moved(moves)[floor.covered]), floor.place);
}

/// A texel of which nothing is seen stays where it is.
TEST(LeaveHollows, PlaceWhoseSquareIsCovered_Stays) {
  const CoveredFloor floor(0.9f);
  const LightMapTexel moved = floor.moved()[floor.covered];
  EXPECT_EQ(moved.face, floor.layout.texels[floor.covered].face);
  EXPECT_LT(besideOf(positionOf(floor.scene, moved), floor.place), 0.6);
}

}  // namespace
}  // namespace prelight::test
