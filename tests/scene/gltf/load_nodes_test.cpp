#include <gtest/gtest.h>

#include <cmath>

#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;
using test::triangleDocument;

GltfDocument documentWithNodes(const char* nodes) {
  GltfDocument document = triangleDocument();
  document.json["nodes"] = Json::parse(nodes);
  document.json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
                      {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": -3, "znear": 0, "zfar": 9}}])");
  return document;
}

GltfDocument documentWithLight(const char* light, const char* node) {
  GltfDocument document = documentWithNodes(node);
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({Json::parse(light)});
  document.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return document;
}

Light loadLight(const char* light, const char* node, Warnings& warnings) {
  return test::reload(documentWithLight(light, node), warnings).lights.at(0);
}

TEST(LoadNodes, HierarchyOfTrsAndMatrix_Multiplies) {
  Warnings warnings;
  const Scene scene = test::reload(documentWithNodes(R"([
    {"children": [1], "translation": [1, 2, 3], "scale": [2, 2, 2]},
    {"mesh": 0, "matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 10,0,0,1]}])"),
                                   warnings);
  ASSERT_EQ(scene.meshNodes.size(), 1u);
  const glm::dvec4 p = scene.meshNodes[0].transforms[0] * glm::dvec4(1, 0, 0, 1);
  EXPECT_EQ(p, glm::dvec4(21, 4, 3, 1));
}

TEST(LoadNodes, LongAndZeroQuaternions_AreNormalisedOrDropped) {
  Warnings warnings;
  Scene scene = test::reload(documentWithNodes(R"([{"mesh": 0, "rotation": [0, 0, 5, 5]}])"), warnings);
  EXPECT_NEAR((scene.meshNodes[0].transforms[0] * glm::dvec4(1, 0, 0, 0)).y, 1.0, 1e-12);
  EXPECT_TRUE(warnings.empty());
  scene = test::reload(documentWithNodes(R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"), warnings);
  EXPECT_EQ(scene.meshNodes[0].transforms[0], glm::dmat4(1.0));
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadNodes, OtherSceneAndNoScene_ChooseTheirRoots) {
  GltfDocument document = documentWithNodes(R"([{"mesh": 0}, {"mesh": 0}, {"mesh": 0}])");
  document.json["scenes"] = Json::parse(R"([{"nodes": [0]}, {"nodes": [2, 1], "name": "second"}])");
  document.json["scene"] = 1;
  Warnings warnings;
  const Scene second = test::reload(document, warnings);
  ASSERT_EQ(second.meshNodes.size(), 2u);
  EXPECT_EQ(second.meshNodes[0].node, 2);
  EXPECT_EQ(second.name, "second");
  document.json.erase("scene");
  EXPECT_EQ(test::reload(document, warnings).meshNodes.size(), 1u);
  document.json.erase("scenes");
  EXPECT_EQ(test::reload(document, warnings).meshNodes.size(), 3u);
}

TEST(LoadNodes, GpuInstancing_PlacesEachInstanceUnderTheNode) {
  GltfDocument document = documentWithNodes(R"([{"mesh": 0, "translation": [0, 0, 1]}])");
  const int offsets = test::appendFloats(document, {1, 0, 0, 2, 0, 0}, "VEC3");
  const int scales = test::appendFloats(document, {1, 1, 1, 3, 3, 3}, "VEC3");
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", offsets}, {"SCALE", scales}};
  document.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  ASSERT_EQ(scene.meshNodes[0].transforms.size(), 2u);
  EXPECT_EQ(scene.meshNodes[0].transforms[1] * glm::dvec4(1, 0, 0, 1), glm::dvec4(5, 0, 1, 1));
  const CompiledScene compiled = compileScene(scene, warnings);
  EXPECT_EQ(compiled.triangleCount(), 2u);
  EXPECT_EQ(compiled.primitives[1].instance, 1);
}

TEST(LoadLight, ScaledNode_KeepsIntensityRangeAndDirection) {
  Warnings warnings;
  const Light light = loadLight(
      R"({"type": "spot", "intensity": 5, "color": [1, 0.5, 0], "range": 4, "spot": {"outerConeAngle": 0.5}})",
      R"([{"scale": [1e-170, 1e-170, 1e-170], "rotation": [0.70710678118654757, 0, 0, 0.70710678118654757],
           "translation": [1, 2, 3]}])",
      warnings);
  EXPECT_EQ(light.type, LightType::Spot);
  EXPECT_EQ(light.intensity, glm::vec3(5.0f, 2.5f, 0.0f));
  EXPECT_EQ(light.range, 4.0f);
  EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
  EXPECT_NEAR(light.direction.y, 1.0, 1e-12);  // -Z turned by 90 degrees around X.
  EXPECT_FLOAT_EQ(light.outerConeAngle, 0.5f);
}

TEST(LoadLight, IntegerNumbersBeyond32Bits_AreRead) {
  Warnings warnings;
  EXPECT_EQ(loadLight(R"({"type": "point", "intensity": 5000000000})", "[{}]", warnings).intensity.x, 5e9f);
}

TEST(LoadLight, NegativeIntensityAndWideCone_ClampWithWarnings) {
  Warnings warnings;
  const Light light =
      loadLight(R"({"type": "spot", "intensity": -5, "spot": {"innerConeAngle": 3, "outerConeAngle": 2}})",
                "[{}]", warnings);
  EXPECT_EQ(light.intensity.x, 0.0f);
  EXPECT_LE(light.outerConeAngle, 1.5707964f);
  EXPECT_LE(light.innerConeAngle, light.outerConeAngle);
  EXPECT_EQ(warnings.size(), 3u);
}

TEST(LoadLight, Sizes_AreInTheExtras) {
  Warnings warnings;
  EXPECT_EQ(loadLight(R"({"type": "point", "extras": {"radius": 0.25}})", "[{}]", warnings).radius, 0.25f);
  EXPECT_EQ(
      loadLight(R"({"type": "directional", "extras": {"angle": 0.5, "radius": 3}})", "[{}]", warnings).radius,
      0.25f);
  for (const char* extras : {R"("sun")", R"({"radius": "large"})", R"({"angle": 1})", "null"})
    EXPECT_EQ(
        loadLight((R"({"type": "point", "extras": )" + std::string(extras) + "}").c_str(), "[{}]", warnings)
            .radius,
        0.0f);
  EXPECT_TRUE(warnings.empty());
}

TEST(LoadLight, IntensityBeyondFloat_Throws) {
  Warnings warnings;
  const std::string message =
      test::inputErrorOf([&] { loadLight(R"({"type": "point", "intensity": 1e200})", "[{}]", warnings); });
  EXPECT_NE(message.find("/extensions/KHR_lights_punctual/lights/0/intensity"), std::string::npos) << message;
}

TEST(LoadLight, BeyondMeasure_Throws) {
  Warnings warnings;
  EXPECT_NE(test::inputErrorOf([&] {
              loadLight(R"({"type": "point", "intensity": 1e20})", "[{}]", warnings);
            }).find("at most 1e+15"),
            std::string::npos);
  EXPECT_NE(test::inputErrorOf([&] {
              loadLight(R"({"type": "point"})", R"([{"translation": [0, 1e20, 0]}])", warnings);
            }).find("/nodes/0: its light or camera"),
            std::string::npos);
}

TEST(LoadCamera, ScaledNode_KeepsRotationAndTranslationOnly) {
  Warnings warnings;
  const Scene scene = test::reload(
      documentWithNodes(
          R"([{"camera": 0, "scale": [3, 4, 5], "rotation": [0, 1, 0, 0], "translation": [7, 8, 9]}])"),
      warnings);
  const glm::dmat4& world = scene.cameras.at(0).world;
  EXPECT_NEAR(glm::length(world[0] - glm::dvec4(-1, 0, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(world[2] - glm::dvec4(0, 0, -1, 0)), 0.0, 1e-12);
  EXPECT_EQ(world[3], glm::dvec4(7, 8, 9, 1));
  EXPECT_EQ(scene.cameras[0].aspect, 0.0);
}

TEST(LoadCamera, Orthographic_TakesMagnitudes) {
  Warnings warnings;
  const Camera camera = test::reload(documentWithNodes(R"([{"camera": 1}])"), warnings).cameras.at(0);
  EXPECT_FALSE(camera.perspective);
  EXPECT_EQ(camera.xMag, 2.0);
  EXPECT_EQ(camera.yMag, 3.0);
}

TEST(LoadScene, Skin_WarnsAndUsesTheBindPose) {
  GltfDocument document = triangleDocument();
  document.json["skins"] = Json::parse(R"([{"joints": [0]}])");
  document.json["nodes"][0]["skin"] = 0;
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshNodes.size(), 1u);
  EXPECT_TRUE(test::anyContains(warnings, "/nodes/0/skin"));
}

}  // namespace
}  // namespace prelight
