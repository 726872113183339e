#include "radiosity/elements.h"

#include <gtest/gtest.h>

#include <random>

#include "prelight/error.h"
#include "support/scenes.h"

namespace prelight {
namespace {

TEST(Elements, EveryPiece_IsFoundFromItsOwnPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.02, 0.98);
  for (const std::uint32_t splits : {1u, 2u, 3u, 7u, 64u, 1000u}) {
    for (int i = 0; i < 2000; ++i) {
      const auto piece = static_cast<std::uint32_t>(random() % (splits * splits));
      glm::dvec2 inPiece(unit(random), unit(random));
      if (inPiece.x + inPiece.y > 0.98) inPiece = 0.98 - inPiece;
      const glm::dvec2 p = pointOfPiece(splits, piece, glm::max(inPiece, 0.005));
      ASSERT_EQ(pieceAt(splits, p.x, p.y), piece) << splits;
      ASSERT_GE(p.x, 0.0);
      ASSERT_LE(p.x + p.y, 1.0 + 1e-12);
    }
  }
}

TEST(Elements, PointsOnEdgesAndCorners_LieInSomePiece) {
  for (const std::uint32_t splits : {1u, 2u, 5u, 33u})
    for (int i = 0; i <= 100; ++i) {
      const double x = i / 100.0;
      EXPECT_LT(pieceAt(splits, x, 1.0 - x), splits * splits);
      EXPECT_LT(pieceAt(splits, x, 0.0), splits * splits);
      EXPECT_LT(pieceAt(splits, 0.0, x), splits * splits);
    }
}

TEST(Elements, TwoTriangleWall_IsCutToThePatchSize) {
  const CompiledScene wall = test::ground(1, 2.0f);
  const RadiosityElements elements = makeElements(wall, 0.5);
  // The diagonals are 4 sqrt(2) m long.
  EXPECT_EQ(elements.splits[0], 12u);
  EXPECT_EQ(elements.perSide(), 2u * 144u);
  EXPECT_NEAR(elements.areas[0] * 288.0, 16.0, 1e-5);
  EXPECT_EQ(elements.triangleOf(143), 0u);
  EXPECT_EQ(elements.triangleOf(144), 1u);
  EXPECT_EQ(elements.triangleOf(288 + 144), 1u);
  EXPECT_EQ(elements.sideOf(288), Side::Back);
}

TEST(Elements, DefaultPatchSize_MakesThousandsOfElementsOfACoarseMesh) {
  const CompiledScene room = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  const RadiosityElements elements = makeElements(room, defaultPatchSize(room));
  EXPECT_GT(elements.perSide(), 4000u);
  EXPECT_LT(elements.perSide(), 40000u);
}

TEST(Elements, TooManyPieces_IsAUsageError) {
  EXPECT_THROW(makeElements(test::ground(1, 1000.0f), 1e-3), UsageError);
}

TEST(ElementPoints, Points_LieInTheirElementsAndLookAlongTheSide) {
  const CompiledScene ball = test::sphere(6, 2.0f, {1, 2, 3});
  const RadiosityElements elements = makeElements(ball, 0.4);
  const ElementPoints points(ball, elements, 7);
  for (std::uint32_t e = 0; e < 2 * elements.perSide(); e += 5) {
    const std::uint32_t t = elements.triangleOf(e);
    for (std::uint32_t i = 0; i < 16; ++i) {
      const ElementPoints::Place place = points.at(e, t, i, 16);
      EXPECT_EQ(elements.first[t] + pieceAt(elements.splits[t], place.sample.b1, place.sample.b2),
                e % elements.perSide());
      const glm::vec3 outwards =
          glm::vec3(place.receiver.position[0], place.receiver.position[1], place.receiver.position[2]) -
          glm::vec3(1, 2, 3);
      const glm::vec3 n(place.receiver.normal[0], place.receiver.normal[1], place.receiver.normal[2]);
      EXPECT_EQ(glm::dot(n, outwards) > 0.0f, elements.sideOf(e) == Side::Front);
    }
  }
}

}  // namespace
}  // namespace prelight
