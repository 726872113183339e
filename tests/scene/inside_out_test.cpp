#include "scene/inside_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A scene with a ball of radius 1 in one mesh; with `inward`, its faces look inside.
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

/// Number of surfaces found inside out in a scene whose only primitive holds `surfaces`.
std::size_t foundIn(const std::vector<CompiledScene>& surfaces) {
  BallScene made(true);
  CompiledScene all = surfaces.front();
  for (std::size_t i = 1; i < surfaces.size(); ++i) test::append(all, surfaces[i]);
  Primitive& primitive = made.scene.meshes[0].primitives[0];
  primitive.positions = all.positions;
  primitive.normals = all.normals;
  primitive.triangles = all.triangles;
  made.compile();
  return made.found();
}

CompiledScene inwardBox(float half, float x = 0.0f) {
  return test::box(2, glm::vec3(x - half, -half, -half), glm::vec3(x + half, half, half), true);
}

TEST(InsideOut, RoomWithFurnitureInOnePrimitive_IsNot) {
  EXPECT_EQ(foundIn({inwardBox(2.0f)}), 1u);
  EXPECT_EQ(foundIn({inwardBox(2.0f), test::box(1, glm::vec3(-0.5f), glm::vec3(0.5f), false)}), 0u);
  EXPECT_EQ(foundIn({inwardBox(2.0f), inwardBox(0.5f)}), 0u);
  EXPECT_EQ(foundIn({inwardBox(2.0f), inwardBox(1.0f, 6.0f)}), 1u);  // Side by side.
}

/// The area vectors of their faces sum to zero, as they do for closed surfaces.
TEST(InsideOut, TubeOrFacingSlabs_AreNot) {
  for (const bool tube : {false, true}) {
    CompiledScene open = inwardBox(1.0f);
    std::erase_if(open.triangles, [&](const glm::uvec3& t) {
      const auto lies = [&](int axis) {
        return std::abs(std::abs(open.positions[t.x][axis]) - 1.0f) < 1e-6f &&
               open.positions[t.x][axis] == open.positions[t.y][axis] &&
               open.positions[t.x][axis] == open.positions[t.z][axis];
      };
      return tube ? lies(1) : !lies(1);
    });
    ASSERT_EQ(open.triangles.size(), tube ? 32u : 16u);
    EXPECT_EQ(foundIn({open}), 0u) << tube;
  }
}

TEST(InsideOut, TurnedTangents_KeepTheirBitangents) {
  BallScene inward(true);
  Primitive& primitive = inward.scene.meshes[0].primitives[0];
  for (const glm::vec3& n : primitive.normals) {
    const glm::vec3 aside = std::abs(n.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    primitive.tangents.emplace_back(glm::normalize(glm::cross(n, aside)), 1.0f);
  }
  const std::vector<glm::vec3> normals = primitive.normals;
  turnFaces(insideOutPrimitives(inward.scene, inward.compiled), inward.scene, inward.compiled);
  const Primitive& turned = inward.scene.meshes[0].primitives[0];
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const glm::vec3 t(turned.tangents[v]);
    EXPECT_LT(
        glm::distance(turned.tangents[v].w * glm::cross(turned.normals[v], t), glm::cross(normals[v], t)),
        1e-6f);
  }
}

TEST(InsideOut, MeshDrawnAsRoomAndBesideIt_IsNot) {
  BallScene beside(true);
  beside.addNode(glm::dmat4(1.0));
  beside.scene.meshNodes.back().transforms[0][3] = {5.0, 0.0, 0.0, 1.0};
  beside.compile();
  EXPECT_EQ(beside.found(), 2u);
  beside.addNode(glm::dmat4(0.2));
  beside.scene.meshNodes.back().transforms[0][3] = {5.3, 0.0, 0.0, 1.0};
  beside.compile();
  EXPECT_EQ(beside.found(), 0u);
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
  EXPECT_TRUE(found.empty());  // The small surface belongs to the same mesh.
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
    Scene scene = loadScene(makeBuiltinScene(name), warnings);
    scene.lights.clear();
    scene.cameras.clear();
    EXPECT_TRUE(insideOutPrimitives(scene, compileScene(scene, warnings)).empty()) << name;
  }
}

}  // namespace
}  // namespace prelight
