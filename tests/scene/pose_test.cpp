#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// An arm that turns a quarter about z within 1 s and carries the triangle, a camera and a spot light 2 m
/// out.
GltfDocument turningArm() {
  GltfDocument document = test::triangleDocument();
  document.json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}])");
  document.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "spot", "spot": {}}])");
  document.json["nodes"] = Json::parse(R"([
    {"name": "arm", "children": [1], "translation": [0, 0, 1]},
    {"name": "tip", "translation": [2, 0, 0], "mesh": 0, "camera": 0,
     "extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  const auto half = static_cast<float>(std::sqrt(0.5));
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int turns = test::appendFloats(document, {0, 0, 0, 1, 0, 0, half, half}, "VEC4");
  document.json["animations"] =
      Json::array({{{"name", "turn"},
                    {"samplers", {{{"input", times}, {"output", turns}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}});
  return document;
}

Scene load(const GltfDocument& document) {
  Warnings warnings;
  return loadScene(document, warnings);
}

void expectNear(const glm::dvec3& got, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(got - expected), 1e-6) << got.x << ' ' << got.y << ' ' << got.z;
}

TEST(SceneAt, ChildrenCamerasAndLights_FollowTheirAncestor) {
  const Scene scene = sceneAt(load(turningArm()), 0, 1.0);
  expectNear(glm::dvec3(scene.meshNodes[0].transforms[0] * glm::dvec4(1, 0, 0, 1)), {0, 3, 1});
  expectNear(glm::dvec3(scene.cameras[0].world[3]), {0, 2, 1});
  expectNear(glm::dvec3(scene.cameras[0].world[0]), {0, 1, 0});
  expectNear(scene.lights[0].position, {0, 2, 1});
  const Scene middle = sceneAt(scene, 0, 0.5);
  expectNear(middle.lights[0].position, {std::sqrt(2.0), std::sqrt(2.0), 1});
}

TEST(SceneAt, StartOfAnAnimationAtRest_IsTheRestPose) {
  const Scene rest = load(turningArm());
  const Scene start = sceneAt(rest, 0, 0.0);
  EXPECT_EQ(start.meshNodes[0].transforms, rest.meshNodes[0].transforms);
  EXPECT_EQ(start.lights[0].position, rest.lights[0].position);
  EXPECT_EQ(start.cameras[0].world, rest.cameras[0].world);
}

TEST(SceneAt, Instances_MoveWithTheirNode) {
  GltfDocument document = turningArm();
  const int offsets = test::appendFloats(document, {0, 0, 0, 1, 0, 0}, "VEC3");
  document.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = offsets;
  const Scene scene = sceneAt(load(document), 0, 1.0);
  ASSERT_EQ(scene.meshNodes[0].transforms.size(), 2u);
  expectNear(glm::dvec3(scene.meshNodes[0].transforms[1] * glm::dvec4(0, 0, 0, 1)), {0, 3, 1});
}

TEST(SceneAt, EveryTime_CompilesToTheSameVerticesInTheSameOrder) {
  Warnings warnings;
  const Scene scene = load(makeBuiltinScene("swing"));
  const CompiledScene rest = compileScene(scene, warnings);
  bool moved = false;
  for (const double time : {0.0, 0.37, 1.9, 4.0}) {
    const CompiledScene posed = compileScene(sceneAt(scene, 0, time), warnings);
    ASSERT_EQ(posed.vertexCount(), rest.vertexCount());
    ASSERT_EQ(posed.triangles, rest.triangles);
    ASSERT_EQ(posed.primitives.size(), rest.primitives.size());
    for (std::size_t p = 0; p < rest.primitives.size(); ++p) {
      EXPECT_EQ(posed.primitives[p].node, rest.primitives[p].node);
      EXPECT_EQ(posed.primitives[p].firstVertex, rest.primitives[p].firstVertex);
    }
    moved = moved || posed.positions != rest.positions;
  }
  EXPECT_TRUE(moved);
  EXPECT_TRUE(warnings.empty());
}

TEST(SceneAt, MissingAnimation_IsAUsageError) {
  const Scene scene = load(turningArm());
  EXPECT_THROW(sceneAt(scene, 1, 0.0), UsageError);
}

TEST(SceneAt, TransformThatIsNotFinite_IsAnInputError) {
  GltfDocument document = turningArm();
  document.json["animations"][0]["channels"][0]["target"]["path"] = "scale";
  document.json["animations"][0]["samplers"][0]["output"] =
      test::appendFloats(document, {1, 1, 1, 3e38f, 3e38f, 3e38f}, "VEC3");
  document.json["nodes"][1]["scale"] = {1e300, 1, 1};
  const Scene scene = load(document);
  const std::string error = test::inputErrorOf([&] { sceneAt(scene, 0, 1.0); });
  EXPECT_NE(error.find("/nodes/1"), std::string::npos) << error;
}

TEST(FindAnimation, NamesAndNumbers_AreTakenAndOthersRefused) {
  GltfDocument document = turningArm();
  document.json["animations"].push_back(document.json["animations"][0]);
  document.json["animations"][1]["name"] = "other";
  Scene scene = load(document);
  EXPECT_EQ(findAnimation(scene, "other"), 1u);
  EXPECT_EQ(findAnimation(scene, "0"), 0u);
  for (const char* bad : {"2", "-1", "1x", "", "tur"})
    EXPECT_THROW(findAnimation(scene, bad), UsageError) << bad;
  scene.animations[1].name = "turn";
  EXPECT_THROW(findAnimation(scene, "turn"), UsageError);
}

TEST(MovesMeshes, OnlyAnimationsOfMeshesOrTheirAncestors_Do) {
  GltfDocument document = turningArm();
  EXPECT_TRUE(movesMeshes(load(document), load(document).animations[0]));
  document.json["nodes"][1].erase("mesh");
  EXPECT_FALSE(movesMeshes(load(document), load(document).animations[0]));
}

}  // namespace
}  // namespace prelight
