#include <gtest/gtest.h>

#include "prelight/error.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// A triangle, a spot light and a camera with an animation of 1 s that does not move anything yet.
GltfDocument stillScene() {
  GltfDocument document = test::triangleDocument();
  document.json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}])");
  document.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "spot", "spot": {}, "intensity": 3, "color": [1, 0.5, 0]}])");
  document.json["nodes"][0]["camera"] = 0;
  document.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  document.json["materials"][0] = Json::parse(R"({"emissiveFactor": [1, 0.5, 0],
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
  document.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual",
                                     "KHR_materials_emissive_strength"};
  test::appendFloats(document, {0, 1}, "SCALAR");  // Accessor 3.
  document.json["animations"] = Json::array({{{"samplers", Json::array()}, {"channels", Json::array()}}});
  return document;
}

void addPointerChannel(GltfDocument& document, const std::string& pointer, const std::vector<float>& values,
                       const std::string& type) {
  auto& animation = document.json["animations"][0];
  const std::size_t sampler = animation["samplers"].size();
  animation["samplers"].push_back({{"input", 3}, {"output", test::appendFloats(document, values, type)}});
  animation["channels"].push_back(
      {{"sampler", sampler},
       {"target",
        {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
}

Scene posedStill(const GltfDocument& document, double seconds) {
  Warnings warnings;
  Scene scene = sceneAt(test::reload(document, warnings), 0, seconds);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return scene;
}

TEST(AnimationPointers, NodesOfPointers_MoveAsThoseOfChannels) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/nodes/0/translation", {0, 0, 0, 2, 0, 0}, "VEC3");
  EXPECT_EQ(posedStill(document, 0.5).meshNodes[0].transforms[0][3], glm::dvec4(1, 0, 0, 1));
}

TEST(AnimationPointers, MaterialsLightsAndCameras_AreFollowed) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/materials/0/pbrMetallicRoughness/baseColorFactor",
                    {0, 0, 0, 1, 1, 0.5f, 0, 1}, "VEC4");
  addPointerChannel(document, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0, 1}, "SCALAR");
  addPointerChannel(document, "/cameras/0/perspective/yfov", {0.5f, 1.5f}, "SCALAR");
  addPointerChannel(document, "/extensions/KHR_lights_punctual/lights/0/range", {0, 8}, "SCALAR");
  const Scene scene = posedStill(document, 0.5);
  EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.5f, 0.25f, 0, 1));
  EXPECT_EQ(scene.materials[0].roughness, 0.5f);
  EXPECT_NEAR(scene.cameras[0].yFov, 1.0, 1e-6);
  EXPECT_EQ(scene.lights[0].range, 4.0f);
}

TEST(AnimationPointers, ColourAndWhatMultipliesIt_AreOneProperty) {
  const char* color = "/extensions/KHR_lights_punctual/lights/0/color";
  const char* intensity = "/extensions/KHR_lights_punctual/lights/0/intensity";
  GltfDocument document = stillScene();
  addPointerChannel(document, intensity, {0, 10}, "SCALAR");
  addPointerChannel(document, "/materials/0/emissiveFactor", {0, 0, 0, 0, 1, 1}, "VEC3");
  EXPECT_EQ(posedStill(document, 1.0).lights[0].intensity, glm::vec3(10, 5, 0));
  EXPECT_EQ(posedStill(document, 1.0).materials[0].emission, glm::vec3(0, 4, 4));
  addPointerChannel(document, color, {0, 0, 0, 0, 0, 1}, "VEC3");
  addPointerChannel(document, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength",
                    {1, 2}, "SCALAR");
  EXPECT_EQ(posedStill(document, 1.0).lights[0].intensity, glm::vec3(0, 0, 10));
  EXPECT_EQ(posedStill(document, 1.0).materials[0].emission, glm::vec3(0, 2, 2));
}

TEST(AnimationPointers, ValuesBeyondWhatFilesMaySay_AreClamped) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/materials/0/pbrMetallicRoughness/metallicFactor", {-1, 3}, "SCALAR");
  EXPECT_EQ(posedStill(document, 0.0).materials[0].metallic, 0.0f);
  EXPECT_EQ(posedStill(document, 1.0).materials[0].metallic, 1.0f);
}

TEST(AnimationPointers, IntegersThatAreNotNormalised_AreTheNumbersTheyAre) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/extensions/KHR_lights_punctual/lights/0/range", {0, 0}, "SCALAR");
  const int bytes = test::appendBytes(document, {0, 200}, "SCALAR", 2, 5121);
  document.json["animations"][0]["samplers"][0]["output"] = bytes;
  EXPECT_EQ(posedStill(document, 0.5).lights[0].range, 100.0f);
  document.json["accessors"][static_cast<std::size_t>(bytes)]["normalized"] = true;
  EXPECT_NEAR(posedStill(document, 1.0).lights[0].range, 200.0 / 255.0, 1e-6);
}

TEST(AnimationPointers, WhatAnotherAnimationChanges_Rests) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0.25f, 0.25f}, "SCALAR");
  document.json["animations"].push_back({{"samplers", Json::array()}, {"channels", Json::array()}});
  Scene scene = posedStill(document, 0.0);
  EXPECT_EQ(scene.materials[0].roughness, 0.25f);
  setPose(scene, 1, 0.0);
  EXPECT_EQ(scene.materials[0].roughness, 1.0f);
}

TEST(AnimationPointers, SurfacesThatChange_ChangeTransportAndLightsDoNot) {
  GltfDocument document = stillScene();
  addPointerChannel(document, "/extensions/KHR_lights_punctual/lights/0/intensity", {0, 10}, "SCALAR");
  Scene scene = posedStill(document, 0.0);
  EXPECT_FALSE(changesTransport(scene, scene.animations[0]));
  addPointerChannel(document, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 1, 1, 1, 1, 1},
                    "VEC4");
  scene = posedStill(document, 0.0);
  EXPECT_TRUE(changesTransport(scene, scene.animations[0]));
  EXPECT_FALSE(movesMeshes(scene, scene.animations[0]));
}

TEST(AnimationPointers, WhatIsNotFollowed_RestsWithAWarningThatNamesIt) {
  GltfDocument document = stillScene();
  const char* pointer = "/materials/0/occlusionTexture/strength";
  addPointerChannel(document, pointer, {0, 1}, "SCALAR");
  Warnings warnings;
  EXPECT_TRUE(test::reload(document, warnings).animations[0].properties.empty());
  EXPECT_TRUE(test::anyContains(warnings, pointer));
}

TEST(AnimationPointers, BadPointers_AreRefusedWithTheirPlace) {
  for (const auto& [pointer, type, part] :
       {std::tuple{"/materials/7/emissiveFactor", "VEC3", "leads to nothing"},
        {"/nodes/9/translation", "VEC3", "leads to nothing"},
        {"/materials/0/emissiveFactor", "VEC4", "VEC3"}}) {
    GltfDocument document = stillScene();
    addPointerChannel(document, pointer, std::vector<float>(type == std::string("VEC3") ? 6 : 8, 0.0f), type);
    Warnings warnings;
    const std::string error = test::inputErrorOf([&] { test::reload(document, warnings); });
    EXPECT_NE(error.find("/animations/0/"), std::string::npos) << error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
  }
  GltfDocument document = stillScene();
  addPointerChannel(document, "/materials/0/emissiveFactor", std::vector<float>(6, 0.0f), "VEC3");
  addPointerChannel(document, "/materials/0/emissiveFactor", std::vector<float>(6, 0.0f), "VEC3");
  Warnings warnings;
  EXPECT_NE(test::inputErrorOf([&] { test::reload(document, warnings); }).find("twice"), std::string::npos);
}

/// A triangle with material variants; red is its own material.
GltfDocument variantScene() {
  GltfDocument document = test::triangleDocument();
  document.json["materials"] = Json::parse(R"([{"name": "red"}, {"name": "blue"}])");
  document.json["extensions"]["KHR_materials_variants"] =
      Json::parse(R"({"variants": [{"name": "warm"}, {"name": "cold"}]})");
  document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::parse(R"([{"material": 1, "variants": [1]}])");
  document.json["extensionsUsed"] = {"KHR_materials_variants"};
  return document;
}

TEST(Variants, PrimitivesHaveTheMaterialsOfTheChosenOne) {
  Warnings warnings;
  const auto material = [&](const std::string& variant) {
    return loadScene(variantScene(), warnings, variant).meshes[0].primitives[0].material;
  };
  EXPECT_EQ(material(""), 0);
  EXPECT_EQ(material("warm"), 0) << "a variant that says nothing of a primitive leaves it its own";
  EXPECT_EQ(material("cold"), 1);
  EXPECT_EQ(test::reload(variantScene(), warnings).variants, (std::vector<std::string>{"warm", "cold"}));
  EXPECT_TRUE(warnings.empty());
}

TEST(Variants, UnknownNames_ListWhatThereIs) {
  Warnings warnings;
  try {
    loadScene(variantScene(), warnings, "hot");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("\"warm\", \"cold\""), std::string::npos) << error.what();
  }
}

TEST(Variants, MaterialsThatAreNotThere_AreRefusedWithTheirPlace) {
  GltfDocument document = variantScene();
  document
      .json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] =
      9;
  Warnings warnings;
  const std::string error = test::inputErrorOf([&] { loadScene(document, warnings, "cold"); });
  EXPECT_NE(error.find("/mappings/0/material"), std::string::npos) << error;
}

}  // namespace
}  // namespace prelight
