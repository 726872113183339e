#include "occluders/carried_record.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace prelight {
namespace {

const std::array<OccluderVector, 2> carriedVectors{OccluderVector::Occlusion, OccluderVector::DiffuseNormal};

/// The record of a distant small body at `to`, carried there from the record at `from`. The body does not
/// move.
std::array<glm::vec4, 2> seenFrom(const OccluderView& to, const OccluderView& from, const glm::dvec3& body,
                                  const glm::vec4& normal) {
  OccluderBody ball;
  ball.centre = body;
  ball.reach = ball.radius = 0.5;
  const glm::dvec3 way = glm::normalize(body - from.position);
  const std::array<glm::vec4, 2> record{glm::vec4(0.01f * glm::vec3(way), 0.01f), normal};
  std::array<glm::vec4, 2> carried{};
  carryRecord(carriedVectors, record, from, {}, ball, to, carried);
  return carried;
}

// The receiver moves from 10 m below the body to 10 m beside that place. The direction to the body turns by
// 45 degrees about +z, and the record's vectors turn with it along all three axes.
TEST(CarriedRecord, FromAPlaceBeside_TurnsWithTheWayToTheBody) {
  const OccluderView below{{0, 0, 0}, {0, 1, 0}}, beside{{10, 0, 0}, {0, 1, 0}};
  const glm::vec4 normal(0.1f, -0.3f, 0.2f, 0.4f);
  const auto carried = seenFrom(beside, below, {0, 10, 0}, normal);
  ASSERT_GT(carried[1].w, 0.0f);
  const double scale = double(carried[1].w) / double(normal.w);
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(45.0), glm::dvec3(0, 0, 1)));
  const glm::dvec3 expected = scale * (turn * glm::dvec3(normal));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(carried[1][c]), expected[c], 1e-7) << c;
}

// The receiver moves from below the body to above it. The direction to the body turns by half a turn about
// any perpendicular axis, and lengths stay.
TEST(CarriedRecord, FromTheOtherSide_TurnsByHalf) {
  const OccluderView below{{0, 0, 0}, {0, 1, 0}}, above{{0, 20, 0}, {0, -1, 0}};
  const glm::vec4 normal(0.1f, -0.3f, 0.2f, 0.4f);
  const auto carried = seenFrom(above, below, {0, 10, 0}, normal);
  ASSERT_GT(carried[1].w, 0.0f);
  const double scale = double(carried[1].w) / double(normal.w);
  EXPECT_NEAR(double(carried[1].y), scale * 0.3, 1e-7);
  EXPECT_NEAR(glm::length(glm::dvec3(carried[1])), scale * glm::length(glm::dvec3(normal)), 1e-7);
}

// The form factor of a small ball is proportional to the cosine over the squared distance: cos 45 degrees /
// 2.
TEST(CarriedRecord, FromAPlaceBeside_SeesTheFormFactorOfItsBall) {
  const OccluderView below{{0, 0, 0}, {0, 1, 0}}, beside{{10, 0, 0}, {0, 1, 0}};
  const auto carried = seenFrom(beside, below, {0, 10, 0}, glm::vec4(0, -0.4f, 0, 0.4f));
  EXPECT_NEAR(carried[0].w, 0.01 * std::sqrt(0.5) / 2.0, 0.01 * 0.005);
  const glm::dvec3 way = glm::normalize(glm::dvec3(-10, 10, 0));
  EXPECT_NEAR(glm::dot(glm::normalize(glm::dvec3(carried[0])), way), 1.0, 1e-6);
}

}  // namespace
}  // namespace prelight
