#include "scene/inside_out.h"

#include <gtest/gtest.h>

#include "scene/builtin/builtin.h"
#include "scene/gltf/loader.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A scene of a ball of radius 1 in one mesh; `inward`: its faces look inside.
struct BallScene {
  Scene scene;
  CompiledScene compiled;

  explicit BallScene(bool inward, bool halved = false) {
    const CompiledScene ball = test::sphere(12, 1.0f, glm::vec3(0.0f));
    Primitive primitive;
    primitive.positions = ball.positions;
    for (const glm::vec3& p : ball.positions) primitive.normals.push_back((inward ? -1.0f : 1.0f) * p);
    primitive.triangles = ball.triangles;
    if (halved) primitive.triangles.resize(primitive.triangles.size() / 2);
    if (inward)
      for (glm::uvec3& t : primitive.triangles) std::swap(t.y, t.z);
    scene.meshes.push_back({"ball", {primitive}});
    addNode(glm::dmat4(1.0));
    compile();
  }

  void addNode(const glm::dmat4& transform) {
    MeshNode node;
    node.mesh = 0;
    node.transforms = {transform};
    scene.meshNodes.push_back(node);
  }

  void compile() {
    Warnings warnings;
    compiled = compileScene(scene, warnings);
  }

  std::size_t found() const { return insideOutPrimitives(scene, compiled).size(); }
};

TEST(InsideOut, InwardBallWithNothingInside_IsFoundAndTurned) {
  BallScene inward(true);
  ASSERT_EQ(inward.found(), 1u);
  turnFaces(insideOutPrimitives(inward.scene, inward.compiled), inward.scene, inward.compiled);
  EXPECT_EQ(inward.found(), 0u);
  const BallScene outward(false);
  EXPECT_EQ(outward.found(), 0u);
  for (std::uint32_t t = 0; t < outward.compiled.triangleCount(); ++t) {
    const glm::uvec3& corners = inward.compiled.triangles[t];
    EXPECT_GT(glm::dot(geometricNormal(inward.compiled, t), glm::dvec3(inward.compiled.positions[corners.x])),
              0.0);
    EXPECT_GT(glm::dot(inward.compiled.normals[corners.x], inward.compiled.positions[corners.x]), 0.0f);
  }
}

TEST(InsideOut, OpenBowl_IsNot) { EXPECT_EQ(BallScene(true, true).found(), 0u); }

TEST(InsideOut, RoomWithSomethingInside_IsNot) {
  BallScene lamp(true), camera(true), thing(true);
  Light light;
  light.intensity = glm::vec3(1.0f);
  lamp.scene.lights = {light};
  EXPECT_EQ(lamp.found(), 0u);
  camera.scene.cameras.emplace_back();
  EXPECT_EQ(camera.found(), 0u);
  thing.addNode(glm::dmat4(0.2));
  thing.scene.meshNodes.back().transforms[0][3] = {0.5, 0.0, 0.0, 1.0};
  thing.compile();
  const auto found = insideOutPrimitives(thing.scene, thing.compiled);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], 1u);  // the small one alone
}

TEST(InsideOut, TwoSidedOrEmissive_IsNot) {
  BallScene two(true), glowing(true);
  for (CompiledMaterial& material : two.compiled.materials) material.doubleSided = true;
  EXPECT_EQ(two.found(), 0u);
  for (CompiledMaterial& material : glowing.compiled.materials) material.emission = glm::vec3(1.0f);
  EXPECT_EQ(glowing.found(), 0u);
}

TEST(InsideOut, BuiltinScenes_AreNot) {
  for (const char* name : {"shapes", "cornell", "caustics", "rooms"}) {
    Warnings warnings;
    const Scene scene = loadScene(makeBuiltinScene(name), warnings);
    EXPECT_TRUE(insideOutPrimitives(scene, compileScene(scene, warnings)).empty()) << name;
  }
}

}  // namespace
}  // namespace prelight
