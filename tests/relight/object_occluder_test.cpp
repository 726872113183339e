// Objects as vector occluders: balls compared with themselves, shadows with those of rays.
#include "relight/object_occluder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "relight/object_light.h"
#include "relight/object_over_floor.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using test::ObjectOverFloor;
using test::rmsDifference;

TEST(ObjectOccluder, OfABall_IsTheBallFromAnywhere) {
  const ObjectOverFloor over(test::sphere(48, 0.3f, {0.2f, 0.8f, 0.0f}));
  const Tracer whole(over.scene, test::sharedDevice());
  const ObjectOccluder occluder(over.scene, over.object, whole);
  for (const glm::dvec3 from : {glm::dvec3(0.2, 0, 0), glm::dvec3(-2, 0, 1), glm::dvec3(1, 3, -1)}) {
    const ObjectBall ball = occluder.seenFrom(from);
    EXPECT_NEAR(ball.radius, 0.3, 0.012);
    EXPECT_LT(glm::distance(ball.centre, glm::dvec3(0.2, 0.8, 0.0)), 0.02);
  }
}

// A plate hides its area as seen from the front, and little as seen from 7 degrees off its edge.
TEST(ObjectOccluder, OfAPlate_IsAsLargeAsItIsSeen) {
  const ObjectOverFloor over(test::box(2, {-0.5f, 0.5f, -0.01f}, {0.5f, 1.5f, 0.01f}, false));
  const Tracer whole(over.scene, test::sharedDevice());
  const ObjectOccluder occluder(over.scene, over.object, whole);
  const double face = std::sqrt(1.0 / std::numbers::pi);
  EXPECT_NEAR(occluder.seenFrom({0.0, 1.0, 9.0}).radius, face, 0.04 * face);
  const double edge = std::sqrt((0.02 + std::sin(std::atan(0.125))) / std::numbers::pi);
  EXPECT_NEAR(occluder.seenFrom({9.0, 1.0, 0.0}).radius, edge, 0.1 * edge);
}

TEST(ObjectOccluder, TurnedAndMoved_IsSeenAsBefore) {
  const CompiledScene box = test::box(2, {-1, 0.5f, -0.2f}, {1, 0.9f, 0.2f}, false);
  ObjectOverFloor over(box);
  const Tracer whole(over.scene, test::sharedDevice());
  ObjectOccluder occluder(over.scene, over.object, whole);
  const glm::dvec3 from(1.3, 0.1, 2.1);
  const ObjectBall before = occluder.seenFrom(from);
  const glm::dmat4 motion =
      glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.4, 0.3, -0.7)), 0.9, glm::dvec3(0, 1, 0));
  over.place(motion, box);
  occluder.follow(over.scene);
  const ObjectBall after = occluder.seenFrom(glm::dvec3(motion * glm::dvec4(from, 1.0)));
  EXPECT_NEAR(after.radius, before.radius, 1e-6);
  EXPECT_LT(glm::distance(after.centre, glm::dvec3(motion * glm::dvec4(before.centre, 1.0))), 1e-5);
  over.place(glm::dmat4(1.0), box);
  occluder.follow(over.scene);
  EXPECT_EQ(occluder.seenFrom(from).centre, before.centre);
}

TEST(ObjectOccluder, Lamp_IsHiddenBehindTheBallAlone) {
  const ObjectBall ball{{0, 1, 0}, 0.5};
  const glm::dvec3 below(0.0);
  EXPECT_EQ(lampPast(ball, below, {{0, 3, 0}, false, 1.0}), 0.0);
  EXPECT_EQ(lampPast(ball, below, {{0, 1, 0}, true, 1.0}), 0.0);
  EXPECT_EQ(lampPast(ball, below, {{0, 0.4, 0}, false, 1.0}), 1.0) << "before the ball";
  EXPECT_EQ(lampPast(ball, below, {{3, 3, 0}, false, 1.0}), 1.0);
  const double rim = std::asin(0.5);
  EXPECT_NEAR(lampPast(ball, below, {{std::sin(rim), std::cos(rim), 0}, true, 1.0}), 0.5, 1e-9);
  EXPECT_EQ(lampPast(ball, {0, 0.8, 0}, {{3, 3, 0}, false, 1.0}), 0.0) << "within the ball";
  EXPECT_EQ(lampPast(ball, {0, 0.8, 0}, {{0, -1, 0}, true, 1.0}), 1.0)
      << "within it, and away from its middle";
}

// Under an open sky, 64 rays per vertex have noise of some percent.
TEST(ObjectOccluder, BallOverAFloor_ShadesAsRaysDo) {
  const ObjectOverFloor over(test::sphere(32, 0.3f, {0.1f, 0.6f, -0.2f}));
  ObjectScene rays(over.scene, over.parts(), nullptr, test::sharedDevice());
  ObjectScene balls(over.scene, over.parts(), nullptr, test::sharedDevice());
  balls.shadeByOccluders(over.scene, std::span(&over.object, 1));
  const ObjectShadow traced = rays.shadowOf(over.scene, over.floor, std::span(&over.object, 1), 3);
  const ObjectShadow found = balls.shadowOf(over.scene, over.floor, std::span(&over.object, 1), 3);
  EXPECT_GT(*std::max_element(traced.hidden.begin(), traced.hidden.end()), 0.2f);
  EXPECT_LT(rmsDifference(traced.hidden, found.hidden), 0.05);
  EXPECT_LT(rmsDifference(traced.sky, found.sky), 0.06);
  for (const float share : found.surfaces) EXPECT_EQ(share, 0.0f);
}

// The shadow of a lamp above lies where rays have it, and is as strong.
TEST(ObjectOccluder, BallUnderALamp_HidesItsLightFromTheFloor) {
  ObjectOverFloor over(test::sphere(32, 0.3f, {0.0f, 0.7f, 0.0f}));
  Light lamp;
  lamp.type = LightType::Point;
  lamp.intensity = glm::vec3(5.0f);
  lamp.position = {0.2, 2.0, 0.1};
  over.scene.lights = {lamp};
  const GroupedLights lights = groupLights(over.scene, {});
  ObjectScene rays(over.scene, over.parts(), &lights, test::sharedDevice());
  ObjectScene balls(over.scene, over.parts(), &lights, test::sharedDevice());
  balls.shadeByOccluders(over.scene, std::span(&over.object, 1));
  const std::vector<float> unhidden = rays.lampsOn(over.scene, over.floor, false);
  const std::vector<float> traced = rays.lampsPast(over.scene, over.floor, unhidden);
  const std::vector<float> found = balls.lampsPast(over.scene, over.floor, unhidden);
  double lostToRays = 0.0, lostToBalls = 0.0;
  for (std::size_t i = 0; i < unhidden.size(); ++i) {
    lostToRays += double(unhidden[i] - traced[i]);
    lostToBalls += double(unhidden[i] - found[i]);
  }
  EXPECT_GT(lostToRays, 0.0);
  EXPECT_NEAR(lostToBalls / lostToRays, 1.0, 0.08);
  EXPECT_LT(rmsDifference(traced, found), 0.06);
}

}  // namespace
}  // namespace prelight
