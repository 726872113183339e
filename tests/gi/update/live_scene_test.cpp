#include "gi/update/live_scene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "gi/update/live_scenes.h"
#include "gpu/tracer.h"
#include "prelight/error.h"
#include "scene/compile/compile_parts.h"
#include "scene/light_profile.h"
#include "support/devices.h"
#include "support/profiles.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

/// The scene compiled again with a node moved by its transform, as a file would have it.
CompiledScene compiledAgain(const LoadedScene& loaded, int node, const RigidMotion& motion) {
  Scene scene = loaded.scene;
  glm::dmat4 matrix(motion.rotation);
  matrix[3] = glm::dvec4(motion.translation, 1.0);
  for (MeshNode& n : scene.meshNodes)
    if (n.node == node)
      for (glm::dmat4& transform : n.transforms) transform = matrix * transform;
  Warnings warnings;
  return compileScene(scene, warnings);
}

RigidMotion turned() {
  return {glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)))),
          {0.2, 0.1, -0.3}};
}

TEST(LiveScene, MovedNode_IsWhereCompilingAgainPutsIt) {
  const LoadedScene loaded("shapes");
  LiveScene live(loaded.scene, loaded.compiled);
  const int torus = loaded.node("Torus");
  live.moveNode(torus, turned());
  const CompiledScene again = compiledAgain(loaded, torus, turned());
  ASSERT_EQ(again.positions.size(), live.compiled().positions.size());
  for (std::size_t v = 0; v < again.positions.size(); ++v) {
    const glm::dvec3 expected = glm::dvec3(again.positions[v]) + again.origin;
    const glm::dvec3 got = glm::dvec3(live.compiled().positions[v]) + live.compiled().origin;
    EXPECT_LT(glm::length(expected - got), 2e-6) << v;
    EXPECT_LT(glm::length(again.normals[v] - live.compiled().normals[v]), 2e-6f) << v;
  }
}

TEST(LiveScene, MovedBack_IsWhatItWas) {
  const LoadedScene loaded("cornell");
  LiveScene live(loaded.scene, loaded.compiled);
  const int box = loaded.node("Tall box");
  live.moveNode(box, turned());
  EXPECT_NE(live.compiled().positions, loaded.compiled.positions);
  live.moveNode(box, RigidMotion{});
  EXPECT_EQ(live.compiled().positions, loaded.compiled.positions);
}

TEST(LiveScene, Changes_NameTrianglesAndLightsOnce) {
  const LoadedScene loaded("rooms");
  LiveScene live(loaded.scene, loaded.compiled);
  EXPECT_TRUE(live.takeChanges().empty());
  const int crate = loaded.node("Left crate");
  live.moveNode(crate, shifted(0.1, 0.0, 0.0));
  live.moveNode(crate, shifted(0.2, 0.0, 0.0));
  Light light = live.compiled().lights.at(0);
  light.position.x += 0.1;
  live.setLight(0, light);
  const SceneChange change = live.takeChanges();
  EXPECT_EQ(change.triangles, live.trianglesOf(crate));
  EXPECT_EQ(change.lights, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(live.takeChanges().empty());
}

/// A lamp at a node, with a profile that shines more along its X axis than across.
LoadedScene withProfiledLamp() {
  LoadedScene loaded("rooms");
  const auto oval = makeProfile([](double, double turn) { return 2.0 + std::cos(2.0 * turn); });
  Light& light = loaded.scene.lights.at(0);
  light = profiledLight(light.position, oval, {0, -1, 0}, {1, 0, 0});
  loaded.scene.lights.at(0).sceneNode = 0;
  loaded.compiled = compileScene(loaded.scene, loaded.warnings);
  return loaded;
}

RigidMotion quarterTurn() {
  return {glm::dmat3(glm::rotate(glm::dmat4(1.0), std::numbers::pi / 2.0, glm::dvec3(0.0, 1.0, 0.0))),
          {0.0, 0.0, 0.0}};
}

TEST(LiveScene, TurnedLamp_TakesItsProfileAlong) {
  const LoadedScene loaded = withProfiledLamp();
  const glm::dvec3 along = glm::normalize(glm::dvec3(1, -1, 0)),
                   across = glm::normalize(glm::dvec3(0, -1, 1));
  LiveScene live(loaded.scene, loaded.compiled);
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], along), 3.0, 1e-6);
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], across), 1.0, 1e-6);
  const int node = loaded.scene.nodes.at(loaded.scene.lights[0].sceneNode).node;
  live.moveNode(node, quarterTurn());
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], along), 1.0, 1e-6);
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], across), 3.0, 1e-6);
  // setLight() sets the light in the node's current pose; later motions turn it from there.
  live.setLight(0, Light(live.compiled().lights[0]));
  live.moveNode(node, RigidMotion{});
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], along), 3.0, 1e-6);
  EXPECT_NEAR(profileTowards(live.compiled().lights[0], across), 1.0, 1e-6);
}

TEST(LiveScene, WhatCannotMove_IsRefused) {
  const LoadedScene loaded("rooms");
  LiveScene live(loaded.scene, loaded.compiled);
  EXPECT_THROW(live.moveNode(99, RigidMotion{}), UsageError);
  EXPECT_THROW(live.setLight(1, loaded.compiled.lights[0]), UsageError);
  Light other = loaded.compiled.lights[0];
  other.type = LightType::Directional;
  EXPECT_THROW(live.setLight(0, other), UsageError);
}

std::vector<device::Ray> raysThrough(const CompiledScene& scene, std::size_t count) {
  std::mt19937 random(3);
  const glm::vec3 centre = 0.5f * (scene.boundsMin + scene.boundsMax);
  const glm::vec3 half = 0.5f * (scene.boundsMax - scene.boundsMin);
  std::uniform_real_distribution<float> unit(-0.99f, 0.99f);
  std::vector<device::Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 o = centre + half * glm::vec3(unit(random), unit(random), unit(random));
    const glm::vec3 d = randomDirection(random);
    rays.push_back(
        {{o.x, o.y, o.z}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, std::numeric_limits<float>::infinity()});
  }
  return rays;
}

TEST(SeparatedTree, HitsAreThoseOfOneTree_BeforeAndAfterMoving) {
  for (const auto& [name, node] : {std::pair("shapes", "Torus"), std::pair("cornell", "Tall box")}) {
    SCOPED_TRACE(name);
    const LoadedScene loaded(name);
    LiveScene live(loaded.scene, loaded.compiled);
    Tracer tracer(live.compiled(), sharedDevice());
    tracer.separate(live.compiled(), live.trianglesOf(loaded.node(node)));
    const std::vector<device::Ray> rays = raysThrough(live.compiled(), 20000);
    for (const RigidMotion& motion : {RigidMotion{}, turned()}) {
      live.moveNode(loaded.node(node), motion);
      tracer.follow(live.compiled());
      const std::vector<device::Hit> hits = tracer.traceClosest(rays);
      const std::vector<device::Hit> whole = Tracer(live.compiled(), sharedDevice()).traceClosest(rays);
      std::size_t onNode = 0, differ = 0;
      const std::vector<std::uint32_t> moved = live.trianglesOf(loaded.node(node));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle != whole[i].triangle) {
          ++differ;  // Where two triangles meet in an edge, either is right.
          EXPECT_EQ(hits[i].t, whole[i].t) << "ray " << i;
        }
        onNode += std::binary_search(moved.begin(), moved.end(), hits[i].triangle) ? 1 : 0;
      }
      EXPECT_GT(onNode, 100u);
      EXPECT_LT(differ, 10u);
    }
  }
}

TEST(SeparatedTree, EverythingSeparated_IsStillHit) {
  const LoadedScene loaded("cornell");
  std::vector<std::uint32_t> all;
  for (std::uint32_t t = 0; t < loaded.compiled.triangleCount(); ++t) all.push_back(t);
  Tracer tracer(loaded.compiled, sharedDevice());
  tracer.separate(loaded.compiled, all);
  const std::vector<device::Ray> rays = raysThrough(loaded.compiled, 1000);
  const std::vector<device::Hit> hits = tracer.traceClosest(rays), any = tracer.traceAny(rays);
  const std::vector<device::Hit> whole = Tracer(loaded.compiled, sharedDevice()).traceClosest(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].t, whole[i].t);
    EXPECT_EQ(any[i].triangle == PRELIGHT_NO_TRIANGLE, whole[i].triangle == PRELIGHT_NO_TRIANGLE);
  }
  tracer.separate(loaded.compiled, {});
  EXPECT_EQ(tracer.traceSeparated(rays)[0].triangle, PRELIGHT_NO_TRIANGLE);
  EXPECT_EQ(tracer.traceClosest(rays)[0].t, whole[0].t);
}

TEST(LiveScene, Pose_MarksWhatMovedAlone_AndMotionsGoOnFromThere) {
  const LoadedScene loaded("shapes");
  Scene posed = loaded.scene;
  for (MeshNode& node : posed.meshNodes)
    if (node.name == "Cone")
      for (glm::dmat4& transform : node.transforms)
        transform = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.5, 0.0)) * transform;
  CompiledScene compiled = loaded.compiled;
  flattenAnew(posed, compiled, loaded.compiled.origin);
  LiveScene live(loaded.scene, loaded.compiled);
  live.pose(compiled);
  const std::vector<std::uint32_t> cone = live.trianglesOf(loaded.node("Cone"));
  EXPECT_EQ(live.takeChanges().triangles, cone);
  EXPECT_EQ(live.compiled().positions, compiled.positions);
  live.pose(compiled);
  EXPECT_TRUE(live.takeChanges().empty());
  live.moveNode(loaded.node("Cone"), shifted(0.0, -0.5, 0.0));
  for (std::size_t v = 0; v < loaded.compiled.vertexCount(); ++v)
    ASSERT_LT(glm::length(live.compiled().positions[v] - loaded.compiled.positions[v]), 1e-6f);
}

TEST(LiveScene, PoseOfOtherTriangles_IsRefused) {
  const LoadedScene loaded("shapes"), other("rooms");
  LiveScene live(loaded.scene, loaded.compiled);
  EXPECT_THROW(live.pose(other.compiled), UsageError);
  CompiledScene elsewhere = loaded.compiled;
  elsewhere.origin.x += 1.0;
  EXPECT_THROW(live.pose(elsewhere), UsageError);
}

}  // namespace
}  // namespace prelight::test
