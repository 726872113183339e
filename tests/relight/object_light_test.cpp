#include "relight/object_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh.h"
#include "occluders/occluder_record.h"
#include "relight/object_shadow.h"
#include "relight/shadowed_transfer.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/scenes.h"
#include "techniques/volume/volume_light.h"

namespace prelight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inHarmonics = 0.28209479177387814;  // Coefficient of the function 1 divided by 4 pi: Y_00.

/// A scene with balls appended behind the baked part.
struct BallsInScene {
  CompiledScene scene;
  VertexRange baked;
  std::vector<VertexRange> balls;

  explicit BallsInScene(CompiledScene walls)
      : scene(std::move(walls)), baked{0, scene.vertexCount(), 0, scene.triangleCount()} {}

  void add(int segments, float radius, const glm::vec3& centre) {
    const CompiledScene ball = test::sphere(segments, radius, centre);
    balls.push_back({scene.vertexCount(), ball.vertexCount(), scene.triangleCount(), ball.triangleCount()});
    test::append(scene, ball);
  }

  SceneParts parts() const { return {baked.triangleCount, scene.triangleCount()}; }

  /// A convex body with its own transfer.
  VolumeObject object(std::size_t i, const VolumeTransfer& volume) const {
    const int order = VolumeReceiver::ownOrder(volume);
    VolumeObject object{balls[i], {order, 1, 0, {}}};
    std::vector<double> open(static_cast<std::size_t>(order * order));
    for (std::uint32_t v = 0; v < balls[i].vertexCount; ++v) {
      sh::openTransfer(glm::dvec3(scene.normals[balls[i].firstVertex + v]), order, open);
      object.own.coefficients.insert(object.own.coefficients.end(), open.begin(), open.end());
    }
    return object;
  }
};

/// A volume of one cell that sees the part `seen` [i] of the sphere.
VolumeTransfer oneCell(int order, const std::vector<double>& seen) {
  VolumeTransfer volume{{{1, 1, 1}, {-1, -1, -1}, {1, 1, 1}}, order, 1, 0, {}, {}, {1}};
  for (const double value : seen) volume.coefficients.push_back(static_cast<float>(value / (4.0 * pi)));
  return volume;
}

/// SH of the function that is 1 in the hemisphere around an axis and 0 elsewhere.
std::vector<double> hemisphere(int order, const glm::dvec3& axis) {
  std::vector<double> zonal(static_cast<std::size_t>(order)), values(static_cast<std::size_t>(order * order));
  sh::capZonal(0.5 * pi, zonal);
  sh::turnZonal(zonal, axis, values);
  return values;
}

/// Exit radiance over albedo of a vertex with a normal, in the first channel, for a light with coefficient 0
/// alone.
double receivedBy(const VolumeTransfer& volume, const glm::dvec3& normal) {
  const int order = VolumeReceiver::ownOrder(volume);
  std::vector<double> open(static_cast<std::size_t>(order * order));
  sh::openTransfer(normal, order, open);
  const std::vector<float> own(open.begin(), open.end());
  std::vector<float> sh(3 * volume.columns());
  const VolumeCorner cell{0, 1.0};
  VolumeReceiver(volume).receive(std::span(&cell, 1), own, 1, 1.0, {sh, {}});
  return double(sh[0]);
}

TEST(VolumeReceiver, WhereEverythingIsOpen_KeepsItsOwnTransfer) {
  std::vector<double> open(16, 0.0);
  open[0] = std::sqrt(4.0 * pi);
  const VolumeTransfer volume = oneCell(4, open);
  std::vector<float> own, sh(48);
  for (int i = 0; i < 48; ++i) own.push_back(std::sin(1.0f + static_cast<float>(i)));
  const VolumeCorner cell{0, 1.0};
  VolumeReceiver(volume).receive(std::span(&cell, 1), own, 3, 1.0, {sh, {}});
  for (std::size_t i = 0; i < 48; ++i) EXPECT_NEAR(sh[i], own[i], 1e-6) << i;
}

// Where all of it is seen, an even sky of radiance 1 gives an irradiance of pi.
TEST(VolumeReceiver, AboveABlackFloor_GetsWhatTheNormalSeesOfTheSky) {
  const VolumeTransfer volume = oneCell(4, hemisphere(4, {0, 1, 0}));
  const double sky = std::sqrt(4.0 * pi);
  EXPECT_NEAR(sky * receivedBy(volume, {0, 1, 0}), 1.0, 0.02);
  EXPECT_NEAR(sky * receivedBy(volume, {1, 0, 0}), 0.5, 0.02);
  EXPECT_NEAR(sky * receivedBy(volume, {0, -1, 0}), 0.0, 0.02);
}

// Radiance 1 from a hemisphere gives (1 + cos) / 2 x pi; bands above the first add nothing.
TEST(VolumeReceiver, LightOfAFloor_ComesFromBelow) {
  VolumeTransfer volume = oneCell(1, {0.0});
  volume.channels = 3;
  volume.direct = volume.coefficients;
  volume.coefficients.assign(3, 0.0f);
  volume.sentOrder = 2;
  for (int c = 0; c < 3; ++c)
    for (const double value : hemisphere(2, {0, -1, 0})) volume.sent.push_back(static_cast<float>(value));
  for (const double cosine : {-1.0, -0.5, 0.0, 0.6, 1.0}) {
    const glm::dvec3 normal(std::sqrt(1.0 - cosine * cosine), cosine, 0.0);
    EXPECT_NEAR(receivedBy(volume, normal), 0.5 * (1.0 - cosine), 1e-6) << cosine;
  }
}

/// A wall in the plane x = 0, 2 cm thick, between bright cells on its left and dark cells on its right.
struct TwoSides {
  BallsInScene balls{test::box(2, {-0.01f, -3, -3}, {0.01f, 3, 3}, false)};
  VolumeTransfer volume{{{4, 2, 2}, {-1, -0.5, -0.5}, {1, 0.5, 0.5}}, 1, 3, 1, {}, {}, {}};

  TwoSides() {
    for (int v = 0; v < 16; ++v) {
      const float bright = v % 4 < 2 ? 10.0f : 0.0f;
      volume.direct.push_back(0.0f);
      volume.air.push_back(1);
      for (int c = 0; c < 3; ++c) {
        volume.coefficients.push_back(bright);
        volume.sent.push_back(bright);
        volume.lights.push_back(0.5f * bright);
      }
    }
    volume.sentOrder = volume.lightOrder = 1;
    balls.add(6, 0.1f, {-0.13f, 0, 0});
    balls.add(6, 0.1f, {0.13f, 0, 0});
    Light lamp;
    lamp.name = "Lamp";
    lamp.position = {-1.0, 0.0, 0.0};
    balls.scene.lights.push_back(lamp);
  }
};

TEST(ObjectLight, NextToAWall_GetsNothingThroughIt) {
  TwoSides sides;
  EXPECT_GT(sampleVolume(sides.volume, {0.13, 0, 0}).coefficients[0][0], 2.0) << "or nothing could leak";
  const GroupedLights lamps = groupLights(sides.balls.scene, {});
  ObjectLight light(sides.balls.scene, sides.balls.parts(), sides.volume, &lamps, test::sharedDevice());
  const ObjectTransfer bright = light.transferOf(sides.balls.scene, sides.balls.object(0, sides.volume));
  const ObjectTransfer dark = light.transferOf(sides.balls.scene, sides.balls.object(1, sides.volume));
  ASSERT_EQ(dark.lights.size(), dark.sh.size());
  for (std::size_t i = 0; i < dark.sh.size(); ++i) {
    const float normal = sides.balls.scene.normals[sides.balls.balls[0].firstVertex + i / 3].x;
    EXPECT_EQ(dark.sh[i], 0.0f);
    EXPECT_EQ(dark.lights[i], 0.0f);
    // The shadow of the bright ball on the wall dims only the ball's side that faces the wall.
    EXPECT_NEAR(bright.sh[i], 10.0 * inHarmonics, 10.0 * inHarmonics * (normal < -0.9f ? 0.01 : 0.7));
    EXPECT_GT(bright.lights[i], 1.5 * inHarmonics);
  }
}

// Where the lamp shines, it adds I cos / (pi r^2) to the light of surfaces.
TEST(ObjectLight, LampOnItsSide_ShinesAsItDoesInTheOpen) {
  TwoSides sides;
  const GroupedLights lamps = groupLights(sides.balls.scene, {});
  ObjectLight light(sides.balls.scene, sides.balls.parts(), sides.volume, &lamps, test::sharedDevice());
  const ObjectTransfer transfer = light.transferOf(sides.balls.scene, sides.balls.object(0, sides.volume));
  int lit = 0;
  for (std::uint32_t v = 0; v < sides.balls.balls[0].vertexCount; ++v) {
    const std::uint32_t vertex = sides.balls.balls[0].firstVertex + v;
    const glm::dvec3 way = glm::dvec3(-1, 0, 0) - glm::dvec3(sides.balls.scene.positions[vertex]);
    const double distance = glm::length(way);
    const double cosine = glm::dot(way, glm::dvec3(sides.balls.scene.normals[vertex])) / distance;
    // Receivers lie beside their vertex, and some see past the edge of the light.
    if (cosine < 0.3) continue;
    const double expected = 5.0 * inHarmonics + cosine / (pi * distance * distance);
    EXPECT_NEAR(transfer.lights[3 * v], expected, 0.02 * expected);
    ++lit;
  }
  EXPECT_GT(lit, 10);
}

TEST(ObjectLight, ObjectThatMoves_IsLitWhereItIs) {
  TwoSides sides;
  ObjectLight light(sides.balls.scene, sides.balls.parts(), sides.volume, nullptr, test::sharedDevice());
  CompiledScene moved = sides.balls.scene;
  const VertexRange& range = sides.balls.balls[0];
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v)
    moved.positions[v].x += 0.6f;
  light.follow(moved);
  for (const float value : light.transferOf(moved, sides.balls.object(0, sides.volume)).sh)
    EXPECT_EQ(value, 0.0f);
}

TEST(ObjectShadow, BallAboveTheGround_HidesItsFormFactor) {
  for (const bool covered : {false, true}) {
    CompiledScene ground = test::ground(6, 1.5f);
    if (covered) test::append(ground, test::ground(1, 500.0f, 3.0f));
    BallsInScene balls(ground);
    const glm::dvec3 centre(0.2, 0.5, -0.1);
    balls.add(48, 0.3f, glm::vec3(centre));
    const VolumeTransfer volume = oneCell(1, {0.0});
    ObjectLight light(balls.scene, balls.parts(), volume, nullptr, test::sharedDevice());
    const ObjectShadow shadow = light.shadowOf(balls.scene, balls.baked, balls.balls, 2);
    double most = 0.0;
    for (std::uint32_t v = 0; v < 49; ++v) {
      const glm::dvec3 way = centre - glm::dvec3(balls.scene.positions[v]);
      const double hidden = ballFormFactor(glm::normalize(way).y, 0.3 / glm::length(way));
      most = std::max(most, hidden);
      EXPECT_NEAR(shadow.hidden[v], hidden, 0.01) << v;
      EXPECT_NEAR(shadow.surfaces[v], covered ? hidden : 0.0, 0.01) << v;
      EXPECT_NEAR(shadow.sky[4 * v], covered ? 0.0 : hidden * inHarmonics, 0.003) << v;
    }
    EXPECT_GT(most, 0.2);
  }
}

// A floor below a ball, seen from the ball's lowest point at height h: quadrature over rings of the floor.
TEST(OwnShadow, BelowABall_IsWhatTheFloorLosesOfTheSky) {
  BallsInScene balls(test::ground(1, 500.0f));
  constexpr double radius = 0.3, height = 0.2;
  balls.add(64, 0.3f, {0.0f, 0.5f, 0.0f});
  Tracer whole(balls.scene, test::sharedDevice());
  const std::vector<std::uint32_t> floor{0, 1};
  Tracer walls(whole, balls.scene, floor);
  const std::vector<double> shares = shareBesideOwnShadow(balls.scene, balls.balls[0], walls);
  double hidden = 0.0;
  constexpr int rings = 4000;
  for (int k = 0; k < rings; ++k) {
    const double sine2 = (k + 0.5) / rings, across = height * std::sqrt(sine2 / (1.0 - sine2));
    const double distance = std::hypot(across, height + radius);
    hidden += ballFormFactor((height + radius) / distance, radius / distance) / rings;
  }
  EXPECT_GT(hidden, 0.1);
  EXPECT_NEAR(shares.back(), 1.0 - hidden, 0.015) << "the lowest vertex";
  EXPECT_EQ(shares.front(), 1.0) << "the uppermost one sees no floor";
}

CompiledScene rooms() {
  Warnings warnings;
  return compileScene(loadScene(makeBuiltinScene("rooms"), warnings), warnings);
}

Bake bakeLights(const CompiledScene& scene, int volume) {
  BakeRequest request;
  request.sh.order = volume > 0 ? 1 : 0;
  request.lightGroups.wanted = true;
  request.bounces = 4;
  request.effort.rays = volume > 0 ? 2048 : 1024;
  request.volume.size = volume;
  BakeReport report;
  Progress progress;
  return bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report);
}

// The truth is a bake of the scene with the balls in it: in the lit room, and in the other room next to the
// wall, where light from the lit side would be ten times as bright.
TEST(ObjectLight, CarriedThroughRooms_IsLitAsIfBakedThere) {
  BallsInScene balls(rooms());
  const Bake bake = bakeLights(balls.scene, 24);
  const glm::vec3 origin(balls.scene.origin);
  for (const glm::vec3& at : {glm::vec3(-2.2f, 1.0f, 0.5f), glm::vec3(0.45f, 1.0f, 1.2f)})
    balls.add(8, 0.25f, at - origin);
  const Bake truth = bakeLights(balls.scene, 0);
  const GroupedLights lamps = groupLights(balls.scene, {});
  ObjectLight light(balls.scene, balls.parts(), *bake.volume, &lamps, test::sharedDevice());
  for (std::size_t i = 0; i < 2; ++i) {
    const VertexRange& range = balls.balls[i];
    const ObjectTransfer transfer = light.transferOf(balls.scene, balls.object(i, *bake.volume));
    double squares = 0.0, all = 0.0;
    for (std::size_t k = 0; k < range.vertexCount * 3; ++k) {
      const double expected = truth.lightGroups->coefficients[range.firstVertex * 3 + k];
      squares += std::pow(transfer.lights[k] - expected, 2);
      all += expected * expected;
    }
    EXPECT_LT(std::sqrt(squares / all), 0.1) << i;
  }
}

TEST(ShadowedTransfer, WithoutAnObjectNearby_IsTheBakesOwn) {
  BallsInScene balls(test::ground(4, 1.0f));
  Bake bake;
  bake.sh = HarmonicTransfer{1, 3, 1, std::vector<float>(25 * 3, 0.25f)};
  balls.add(6, 0.3f, {0.0f, 0.4f, 0.0f});
  const VolumeTransfer volume = oneCell(1, {0.0});
  ObjectLight light(balls.scene, balls.parts(), volume, nullptr, test::sharedDevice());
  ShadowedTransfer shadowed(balls.scene, balls.baked, bake, light);
  shadowed.writeTo(balls.scene, balls.balls, bake);
  EXPECT_LT(bake.sh->coefficients[3 * 12], 0.2f) << "below the ball";
  for (std::uint32_t v = balls.balls[0].firstVertex; v < balls.scene.vertexCount(); ++v)
    balls.scene.positions[v].y -= 5.0f;
  light.follow(balls.scene);
  shadowed.writeTo(balls.scene, balls.balls, bake);
  for (const float value : bake.sh->coefficients) EXPECT_EQ(value, 0.25f);
}

}  // namespace
}  // namespace prelight
