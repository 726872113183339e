#include "occluders/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace prelight {
namespace {

const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 2.1, glm::normalize(glm::dvec3(1, 2, -3))));
const glm::dvec3 way(3.0, -1.0, 0.5);

/// Points of a spiral, flat if `thickness` is 0.
std::vector<glm::vec3> placesOf(double thickness) {
  std::vector<glm::vec3> places;
  for (int i = 0; i < 40; ++i)
    places.emplace_back(0.1 * i * std::cos(i), 0.1 * i * std::sin(i), thickness * std::cos(2.7 * i));
  return places;
}

TEST(FitMotion, MovedPlaces_GiveTheMotion_FlatOnesToo) {
  for (const double thickness : {1.0, 0.0}) {
    const std::vector<glm::vec3> from = placesOf(thickness);
    std::vector<glm::vec3> to;
    for (const glm::vec3& place : from) to.emplace_back(turn * glm::dvec3(place) + way);
    const RigidFit fit = fitMotion(from, to);
    EXPECT_LT(fit.deviation, 1e-5);
    EXPECT_NEAR(glm::determinant(fit.motion.rotation), 1.0, 1e-9);
    for (int column = 0; column < 3; ++column)
      EXPECT_LT(glm::distance(fit.motion.rotation[column], turn[column]), 1e-5) << thickness;
    EXPECT_LT(glm::distance(fit.motion.translation, way), 1e-5);
  }
}

TEST(FitMotion, SamePlaces_GiveTheIdentityToTheBit) {
  const std::vector<glm::vec3> places = placesOf(1.0);
  const RigidFit fit = fitMotion(places, places);
  EXPECT_EQ(fit.motion, RigidMotion{});
  EXPECT_EQ(fit.deviation, 0.0);
}

TEST(FitMotion, ScaledAndMirroredPlaces_Deviate) {
  const std::vector<glm::vec3> from = placesOf(1.0);
  std::vector<glm::vec3> scaled, mirrored;
  for (const glm::vec3& place : from) {
    scaled.push_back(1.1f * place);
    mirrored.emplace_back(-place.x, place.y, place.z);
  }
  EXPECT_GT(fitMotion(from, scaled).deviation, 0.1);
  EXPECT_GT(fitMotion(from, mirrored).deviation, 0.5);
}

}  // namespace
}  // namespace prelight
