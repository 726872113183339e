#include <gtest/gtest.h>

#include <limits>

#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// A triangle with two targets, which lift the last corner by 1 and by 10.
GltfDocument twoTargets() {
  GltfDocument document = test::triangleDocument();
  Json targets = Json::array();
  for (const float lift : {1.0f, 10.0f})
    targets.push_back({{"POSITION", test::appendFloats(document, {0, 0, 0, 0, 0, 0, 0, 0, lift}, "VEC3")}});
  document.json["meshes"][0]["primitives"][0]["targets"] = targets;
  return document;
}

/// The two targets with weights that go from (0, 0) to (1, 0.5) within 1 s.
GltfDocument animatedTargets() {
  GltfDocument document = twoTargets();
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int weights = test::appendFloats(document, {0, 0, 1, 0.5f}, "SCALAR");
  document.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", weights}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}});
  return document;
}

Scene loadedMorphs(const GltfDocument& document) {
  Warnings warnings;
  Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return scene;
}

double liftAt(const Scene& scene, double seconds) {
  Warnings warnings;
  const CompiledScene compiled = compileScene(sceneAt(scene, 0, seconds), warnings);
  return compiled.origin.z + double(compiled.positions[2].z);
}

void expectMorphError(const GltfDocument& document, const std::vector<std::string>& parts) {
  Warnings warnings;
  const std::string error = test::inputErrorOf([&] { test::reload(document, warnings); });
  for (const std::string& part : parts) EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(MorphWeights, LinearAndStep_AreTakenBetweenTheKeys) {
  GltfDocument document = animatedTargets();
  EXPECT_NEAR(liftAt(loadedMorphs(document), 0.25), 0.25 * 1 + 0.125 * 10, 1e-6);
  EXPECT_NEAR(liftAt(loadedMorphs(document), 2.0), 1 + 0.5 * 10, 1e-6);
  document.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
  EXPECT_NEAR(liftAt(loadedMorphs(document), 0.75), 0.0, 1e-6);
  EXPECT_NEAR(liftAt(loadedMorphs(document), 1.0), 6.0, 1e-6);
}

/// From 0 with an outgoing slope of 4 to 1 with an incoming slope of 0: 4 (t - 2 t^2 + t^3) + 3 t^2 - 2 t^3
/// is 1 at t = 1/2. The second target rests at 0.2.
TEST(MorphWeights, CubicSpline_IsHermites) {
  GltfDocument document = animatedTargets();
  document.json["animations"][0]["samplers"][0] = {
      {"input", document.json["animations"][0]["samplers"][0]["input"]},
      {"output", test::appendFloats(document, {9, 9, 0, 0.2f, 4, 0, 0, 0, 1, 0.2f, 9, 9}, "SCALAR")},
      {"interpolation", "CUBICSPLINE"}};
  const Scene scene = loadedMorphs(document);
  EXPECT_NEAR(liftAt(scene, 0.5), 1.0 + 2.0, 1e-6);
  EXPECT_NEAR(liftAt(scene, 0.0), 2.0, 1e-6);
  EXPECT_NEAR(liftAt(scene, 1.0), 3.0, 1e-6);
}

TEST(MorphWeights, NormalisedBytes_AreSharesOfOne) {
  GltfDocument document = animatedTargets();
  const int bytes = test::appendBytes(document, {0, 0, 255, 51}, "SCALAR", 4, 5121);
  document.json["accessors"][static_cast<std::size_t>(bytes)]["normalized"] = true;
  document.json["animations"][0]["samplers"][0]["output"] = bytes;
  EXPECT_NEAR(liftAt(loadedMorphs(document), 1.0), 1 + 0.2 * 10, 1e-6);
}

TEST(MorphWeights, WhatIsNotAnimated_RestsAgain) {
  GltfDocument document = animatedTargets();
  document.json["nodes"][0]["weights"] = {0.0, 0.1};
  document.json["animations"].push_back(
      {{"name", "still"}, {"samplers", Json::array()}, {"channels", Json::array()}});
  Scene scene = loadedMorphs(document);
  setPose(scene, 0, 1.0);
  EXPECT_EQ(scene.meshNodes[0].weights, (std::vector<float>{1.0f, 0.5f}));
  setPose(scene, 1, 0.0);
  EXPECT_EQ(scene.meshNodes[0].weights, (std::vector<float>{0.0f, 0.1f}));
}

TEST(MorphWeights, TheirAnimation_MovesMeshes) {
  const Scene scene = loadedMorphs(animatedTargets());
  EXPECT_TRUE(movesMeshes(scene, scene.animations[0]));
}

TEST(MorphWeights, WrongCounts_AreRefusedOrWarnedOf) {
  GltfDocument document = animatedTargets();
  document.json["animations"][0]["samplers"][0]["output"] = test::appendFloats(document, {0, 0, 1}, "SCALAR");
  expectMorphError(document,
                   {"/animations/0/samplers/0/output", "3 values", "expected 4", "2 morph targets"});
  document = twoTargets();
  document.json["meshes"][0]["weights"] = {0.25};
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshNodes[0].weights, (std::vector<float>{0.25f, 0.0f}));
  EXPECT_TRUE(test::anyContains(warnings, "/meshes/0/weights: 1 weights for 2 morph targets"));
}

TEST(MorphTargets, OtherNumbersOfVertices_AreRefused) {
  GltfDocument document = twoTargets();
  document.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] =
      test::appendFloats(document, {0, 0, 0}, "VEC3");
  expectMorphError(document, {"/meshes/0/primitives/0/targets/1", "1 vertices", "3"});
}

TEST(MorphTargets, OtherCountThanThatOfAnotherPrimitive_IsAWarning) {
  GltfDocument document = twoTargets();
  auto& primitives = document.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["targets"].erase(1);
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_EQ(scene.meshNodes[0].weights.size(), 2u);
  EXPECT_TRUE(test::anyContains(warnings, "/meshes/0/primitives/1: 1 morph targets"));
}

TEST(MorphTargets, AttributeThatThePrimitiveLacks_IsLeftOutWithAWarning) {
  GltfDocument document = twoTargets();
  document.json["meshes"][0]["primitives"][0]["targets"][0]["TANGENT"] = 1;
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(scene.meshes[0].primitives[0].targets[0].tangents.empty());
  EXPECT_TRUE(test::anyContains(warnings, "/targets/0/TANGENT: the primitive has no TANGENT"));
}

TEST(MorphTargets, NumbersThatAreNotFinite_CountAsNone) {
  GltfDocument document = twoTargets();
  document.json["meshes"][0]["weights"] = {1.0, 1.0};
  test::replaceFloats(document, 10.0f, std::numeric_limits<float>::infinity());
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  EXPECT_NEAR(scene.origin.z + double(scene.positions[2].z), 1.0, 1e-6);
  EXPECT_TRUE(test::anyContains(warnings, "/targets/1/POSITION"));
}

/// A megabyte of targets would come from a file of a few hundred bytes.
TEST(MorphTargets, FarMoreThanTheFileHolds_AreRefused) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"].push_back({{"componentType", 5126}, {"count", 3000000}, {"type", "VEC3"}});
  auto& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] = 3;
  primitive["attributes"].erase("NORMAL");
  for (int i = 0; i < 100; ++i) primitive["targets"].push_back({{"POSITION", 3}});
  expectMorphError(document, {"/nodes/0", "vertices"});
}

}  // namespace
}  // namespace prelight
