#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "prelight/prelight.h"
#include "support/devices.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

/// A square of 2 m on the ground in four vertices, with a lamp 1 m above its middle.
class SquareInArrays : public ::testing::Test {
 protected:
  std::vector<glm::vec3> positions_{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  std::vector<glm::vec3> normals_{{0, 2, 0}, {0, 2, 0}, {0, 2, 0}, {0, 2, 0}};
  std::vector<glm::vec2> texCoords_{{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  std::vector<glm::uvec3> triangles_{{0, 1, 2}, {0, 2, 3}};

  SceneArrays arrays() const {
    MeshArrays mesh{.name = "Square", .positions = positions_, .triangles = triangles_};
    mesh.normals = normals_;
    mesh.texCoords = texCoords_;
    mesh.material = 0;
    Light lamp;
    lamp.position = {0.0, 1.0, 0.0};
    lamp.intensity = {8.0f, 4.0f, 2.0f};
    return {.meshes = {mesh},
            .materials = {{.name = "Paint", .baseColor = {0.5f, 0.25f, 0.125f, 1.0f}}},
            .lights = {lamp}};
  }

  /// Error message of a scene from `arrays` after `change`.
  static std::string complaint(SceneArrays arrays, const std::function<void(SceneArrays&)>& change) {
    change(arrays);
    try {
      makeScene(arrays);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(SquareInArrays, Scene_HasWhatTheArraysSay) {
  const LoadedScene scene = makeScene(arrays());
  ASSERT_EQ(scene.compiled.vertexCount(), 4u);
  ASSERT_EQ(scene.compiled.triangleCount(), 2u);
  for (std::uint32_t v = 0; v < 4; ++v) {
    const glm::dvec3 world = glm::dvec3(scene.compiled.positions[v]) + scene.compiled.origin;
    EXPECT_LT(glm::length(world - glm::dvec3(positions_[v])), 1e-6);
    EXPECT_EQ(scene.compiled.normals[v], glm::vec3(0, 1, 0)) << "normals are made unit";
  }
  EXPECT_EQ(scene.scene.meshes[0].primitives[0].texCoords0, texCoords_);
  EXPECT_EQ(scene.compiled.materials[0].albedo, glm::vec3(0.5f, 0.25f, 0.125f));
  ASSERT_EQ(scene.scene.lights.size(), 1u);
  EXPECT_EQ(scene.scene.lights[0].type, LightType::Point);
  EXPECT_LT(glm::length(scene.scene.lights[0].intensity - glm::vec3(8, 4, 2)), 1e-5f);
  EXPECT_EQ(scene.scene.lights[0].position, glm::dvec3(0, 1, 0));
}

TEST_F(SquareInArrays, Material_IsWhatWasGiven) {
  SceneArrays given = arrays();
  PlainMaterial& material = given.materials[0];
  material.emission = {3.0f, 2.0f, 0.0f};
  material.metallic = 0.25f;
  material.roughness = 0.5f;
  material.transmission = 0.75f;
  material.ior = 1.25f;
  material.specular = 0.125f;
  material.solid = material.doubleSided = true;
  material.baseColor.a = 0.5f;
  const LoadedScene scene = makeScene(given);
  const Material& made = scene.scene.materials[0];
  EXPECT_LT(glm::length(made.emission - material.emission), 1e-6f);
  EXPECT_EQ(made.metallic, 0.25f);
  EXPECT_EQ(made.roughness, 0.5f);
  EXPECT_EQ(made.transmission, 0.75f);
  EXPECT_EQ(made.ior, 1.25f);
  EXPECT_EQ(made.specular, 0.125f);
  EXPECT_GT(made.thickness, 0.0f);
  EXPECT_TRUE(made.doubleSided);
  EXPECT_EQ(made.alphaMode, AlphaMode::Blend);
}

TEST_F(SquareInArrays, Transform_MovesTheMesh) {
  SceneArrays moved = arrays();
  moved.meshes[0].toWorld[3] = {10.0, 20.0, 30.0, 1.0};
  const LoadedScene scene = makeScene(moved);
  const glm::dvec3 first = glm::dvec3(scene.compiled.positions[0]) + scene.compiled.origin;
  EXPECT_LT(glm::length(first - glm::dvec3(9.0, 20.0, 31.0)), 1e-5);
}

/// A spot light's cone and direction, and a camera, survive the conversion to the file's form.
TEST_F(SquareInArrays, LightsAndCameras_AreThoseGiven) {
  SceneArrays given = arrays();
  Light spot;
  spot.type = LightType::Spot;
  spot.direction = glm::normalize(glm::dvec3(1.0, -2.0, 3.0));
  spot.innerConeAngle = 0.2f;
  spot.outerConeAngle = 0.5f;
  Light down;
  down.type = LightType::Directional;
  down.direction = {0.0, -1.0, 0.0};
  given.lights = {spot, down};
  Camera camera;
  camera.world[3] = {0.0, 3.0, 0.0, 1.0};
  camera.yFov = 0.7;
  given.cameras = {camera};
  const LoadedScene scene = makeScene(given);
  ASSERT_EQ(scene.scene.lights.size(), 2u);
  EXPECT_LT(glm::length(scene.scene.lights[0].direction - spot.direction), 1e-6);
  EXPECT_FLOAT_EQ(scene.scene.lights[0].innerConeAngle, 0.2f);
  EXPECT_FLOAT_EQ(scene.scene.lights[0].outerConeAngle, 0.5f);
  EXPECT_LT(glm::length(scene.scene.lights[1].direction - down.direction), 1e-6);
  ASSERT_EQ(scene.scene.cameras.size(), 1u);
  EXPECT_EQ(scene.scene.cameras[0].world[3], camera.world[3]);
  EXPECT_DOUBLE_EQ(scene.scene.cameras[0].yFov, 0.7);
}

TEST_F(SquareInArrays, WhatIsBaked_IsSavedAndReadAgain) {
  const LoadedScene scene = makeScene(arrays());
  const BakeResult baked =
      bake(scene, {.ao = true, .effort = {.rays = 64}}, {.device = &test::sharedDevice()});
  for (const float ao : baked.bake.ao) EXPECT_NEAR(ao, 1.0f, 1e-6f) << "nothing stands on the square";
  const test::TemporaryFolder folder;
  save(folder / "square.glb", scene, baked.bake);
  const std::optional<Bake> read = carriedBake(load(folder / "square.glb"));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->ao, baked.bake.ao);
}

TEST_F(SquareInArrays, BadArrays_AreNamed) {
  std::vector<glm::uvec3> beyond{{0, 1, 4}};
  std::vector<glm::vec3> few(3, glm::vec3(0, 1, 0));
  std::vector<glm::vec3> broken = positions_, zero = normals_;
  broken[2].y = std::numeric_limits<float>::quiet_NaN();
  zero[1] = glm::vec3(0.0f);
  const auto said = [&](const std::function<void(SceneArrays&)>& change) {
    return complaint(arrays(), change);
  };
  EXPECT_THAT(said([&](SceneArrays& a) { a.meshes[0].triangles = beyond; }),
              HasSubstr("mesh 0 \"Square\": triangles: triangle 0 has vertex 4, expected one below 4"));
  EXPECT_THAT(said([&](SceneArrays& a) { a.meshes[0].normals = few; }), HasSubstr("normals: got 3 elements"));
  EXPECT_THAT(said([&](SceneArrays& a) { a.meshes[0].normals = zero; }),
              HasSubstr("normals: element 1 is 0"));
  EXPECT_THAT(said([&](SceneArrays& a) { a.meshes[0].positions = broken; }),
              HasSubstr("positions: element 2 is"));
  EXPECT_THAT(said([](SceneArrays& a) { a.meshes[0].material = 1; }), HasSubstr("material: got 1"));
  EXPECT_THAT(said([](SceneArrays& a) { a.meshes[0].toWorld[1] = glm::dvec4(0.0); }), HasSubstr("toWorld"));
  EXPECT_THAT(said([](SceneArrays& a) { a.meshes[0].positions = {}; }), HasSubstr("got 0 vertices"));
  EXPECT_THAT(said([](SceneArrays& a) { a.materials[0].baseColor.x = 2.0f; }),
              HasSubstr("material 0: baseColor"));
  EXPECT_THAT(said([](SceneArrays& a) { a.lights[0].intensity.x = -1.0f; }), HasSubstr("light 0: intensity"));
  EXPECT_THAT(said([](SceneArrays& a) {
                a.lights[0].direction = {0, 0, 2};
              }),
              HasSubstr("light 0: direction"));
  EXPECT_EQ(said([](SceneArrays&) {}), "");
}

}  // namespace
}  // namespace prelight
