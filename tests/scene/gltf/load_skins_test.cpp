#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/gltf/load/loader.h"
#include "support/bent_bar.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

void expectSkinError(const GltfDocument& document, const std::vector<std::string>& parts) {
  Warnings warnings;
  const std::string error = test::inputErrorOf([&] { test::reload(document, warnings); });
  for (const std::string& part : parts) EXPECT_NE(error.find(part), std::string::npos) << error;
}

Scene loadBarWith(const GltfDocument& document, std::string_view warning) {
  Warnings warnings;
  Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, warning)) << (warnings.empty() ? "no warning" : warnings.front());
  return scene;
}

Json& barAttributes(GltfDocument& document) {
  return document.json["meshes"][0]["primitives"][0]["attributes"];
}

/// The bar with the weights `low` and `high` at every vertex.
GltfDocument barOfWeights(float low, float high) {
  GltfDocument document = test::bentBar();
  std::vector<float> weights;
  for (std::size_t v = 0; v < test::barPositions().size(); ++v)
    weights.insert(weights.end(), {low, high, 0, 0});
  barAttributes(document)["WEIGHTS_0"] = test::appendFloats(document, weights, "VEC4");
  return document;
}

TEST(LoadSkins, Joints_ArriveAsTheyAre) {
  Warnings warnings;
  const Scene scene = test::reload(test::bentBar(), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  ASSERT_EQ(scene.skins.size(), 1u);
  EXPECT_EQ(scene.skins[0].name, "skin");
  EXPECT_EQ(scene.skins[0].joints, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(scene.skins[0].inverseBind[1][3], glm::dvec4(0, -1, 0, 1));
  EXPECT_EQ(scene.meshNodes[0].skin, 0);
  EXPECT_EQ(scene.meshNodes[0].transforms, std::vector<glm::dmat4>{glm::dmat4(1.0)});
}

TEST(LoadSkins, JointThatTheSkinLacks_IsRefusedWithItsPlace) {
  GltfDocument document = test::bentBar();
  const std::size_t vertices = test::barPositions().size();
  std::vector<std::uint8_t> joints;
  for (std::size_t v = 0; v < vertices; ++v) joints.insert(joints.end(), {0, 2, 9, 9});
  barAttributes(document)["JOINTS_0"] = test::appendBytes(document, joints, "VEC4", vertices, 5121);
  expectSkinError(document, {"/meshes/0/primitives/0/attributes/JOINTS_0", "vertex 2", "joint 2", "0..1"});
}

TEST(LoadSkins, WeightsThatDoNotSumUpToOne_AreScaledWithAWarning) {
  const Scene scene = loadBarWith(barOfWeights(1.0f, 3.0f), "do not sum up to 1");
  const Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_EQ(primitive.jointWeights[0], 0.25f);
  EXPECT_EQ(primitive.jointWeights[1], 0.75f);
}

TEST(LoadSkins, WeightsThatAreNoShares_CountAsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {-1.0f, nan, std::numeric_limits<float>::infinity()}) {
    const Primitive one =
        loadBarWith(barOfWeights(bad, 1.0f), "below 0 or that are not finite").meshes[0].primitives[0];
    EXPECT_EQ(one.jointWeights[0], 0.0f);
    EXPECT_EQ(one.jointWeights[1], 1.0f);
  }
  const Primitive none = loadBarWith(barOfWeights(0.0f, 0.0f), "no weight").meshes[0].primitives[0];
  EXPECT_EQ(none.jointWeights[0], 1.0f) << "a vertex without weights hangs on its first joint";
}

TEST(LoadSkins, BytesAndShorts_AreSharesOfOne) {
  GltfDocument document = test::bentBar();
  const std::size_t vertices = test::barPositions().size();
  std::vector<std::uint8_t> weights;
  for (std::size_t v = 0; v < vertices; ++v) weights.insert(weights.end(), {51, 204, 0, 0});
  const int accessor = test::appendBytes(document, weights, "VEC4", vertices, 5121);
  document.json["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
  barAttributes(document)["WEIGHTS_0"] = accessor;
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_NEAR(scene.meshes[0].primitives[0].jointWeights[0], 0.2, 1e-7);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST(LoadSkins, NoBindMatrices_MeansTheIdentity) {
  GltfDocument document = test::bentBar();
  document.json["skins"][0].erase("inverseBindMatrices");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_EQ(scene.skins[0].inverseBind, std::vector<glm::dmat4>(2, glm::dmat4(1.0)));
}

TEST(LoadSkins, BadBindMatrices_AreRefusedWithTheirPlace) {
  GltfDocument document = test::bentBar();
  const auto matrices = document.json["skins"][0]["inverseBindMatrices"].get<std::size_t>();
  document.json["accessors"][matrices]["count"] = 1;
  expectSkinError(document, {"/skins/0/inverseBindMatrices", "1 matrices", "expected 2"});
  document.json["skins"][0]["inverseBindMatrices"] = 0;
  expectSkinError(document, {"/skins/0/inverseBindMatrices", "MAT4", "VEC3"});
  document.json["skins"][0]["inverseBindMatrices"] = 99;
  expectSkinError(document, {"/skins/0/inverseBindMatrices", "99"});
}

TEST(LoadSkins, BindMatrixThatIsNotFinite_IsRefused) {
  GltfDocument document = test::bentBar();
  test::replaceFloats(document, -1.0f, std::numeric_limits<float>::quiet_NaN());
  expectSkinError(document, {"/skins/0/inverseBindMatrices", "joint 1", "nan"});
}

TEST(LoadSkins, BadJoints_AreRefusedWithTheirPlace) {
  const auto changed = [](const Json& joints) {
    GltfDocument document = test::bentBar();
    document.json["skins"][0]["joints"] = joints;
    return document;
  };
  expectSkinError(changed(Json::array({0, 7})), {"/skins/0/joints/1", "7"});
  expectSkinError(changed(Json::array({0, 0})), {"/skins/0/joints/1", "twice"});
  expectSkinError(changed(Json::array()), {"/skins/0/joints", "a joint"});
  expectSkinError(changed("x"), {"/skins/0/joints", "array"});
}

TEST(LoadSkins, BrokenSkinThatNothingUses_IsAWarning) {
  GltfDocument document = test::bentBar();
  document.json["skins"].push_back({{"joints", {77}}});
  loadBarWith(document, "/skins/1/joints/0");
}

TEST(LoadSkins, JointsWithoutACommonRoot_AreAppliedWithAWarning) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0].erase("children");
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  EXPECT_EQ(loadBarWith(document, "/skins/0/joints/1: no node is above both").meshNodes[0].skin, 0);
}

TEST(LoadSkins, InstancesOfASkinnedMesh_AreMovedWithAWarning) {
  GltfDocument document = test::bentBar();
  const int offsets = test::appendFloats(document, {0, 0, 0, 4, 0, 0}, "VEC3");
  document.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = offsets;
  document.json["nodes"][2]["translation"] = {0, 0, 9};
  const Scene scene = loadBarWith(document, "instances of a skinned mesh");
  ASSERT_EQ(scene.meshNodes[0].transforms.size(), 2u);
  EXPECT_EQ(scene.meshNodes[0].transforms[1][3], glm::dvec4(4, 0, 0, 1));
}

TEST(LoadSkins, SkinOrWeightsOfANodeWithoutMesh_AreWarnedOf) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0]["skin"] = 0;
  document.json["nodes"][1]["weights"] = {1};
  loadBarWith(document, "/nodes/0/skin");
  loadBarWith(document, "/nodes/1/weights");
}

TEST(LoadSkins, JointOutsideTheScene_LeavesTheSkinOutWithAWarning) {
  GltfDocument document = test::bentBar();
  document.json["scenes"][0]["nodes"] = {2};
  EXPECT_EQ(loadBarWith(document, "/skins/0/joints/0").meshNodes[0].skin, -1);
}

TEST(LoadSkins, MeshWithoutJoints_LeavesTheSkinOutWithAWarning) {
  GltfDocument document = test::bentBar();
  barAttributes(document).erase("JOINTS_0");
  barAttributes(document).erase("WEIGHTS_0");
  EXPECT_EQ(loadBarWith(document, "/nodes/2/skin").meshNodes[0].skin, -1);
}

TEST(LoadSkins, JointsWithoutWeightsAndWrongTypes_AreRefused) {
  GltfDocument document = test::bentBar();
  barAttributes(document).erase("WEIGHTS_0");
  expectSkinError(document, {"/attributes/JOINTS_0", "WEIGHTS_0"});
  document = test::bentBar();
  barAttributes(document)["JOINTS_0"] = barAttributes(document)["WEIGHTS_0"];
  expectSkinError(document, {"/attributes/JOINTS_0", "5126"});
}

}  // namespace
}  // namespace prelight
