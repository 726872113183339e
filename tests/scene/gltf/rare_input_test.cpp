#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prelight/error.h"
#include "scene/gltf/glb_container.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

Json& attributesOf(GltfDocument& document) {
  return document.json["meshes"][0]["primitives"][0]["attributes"];
}

Scene load(const GltfDocument& document, Warnings& warnings) { return loadScene(document, warnings); }

TEST(LoadMeshes, IndexBeyondTheVertices_IsRefusedWithItsPlace) {
  GltfDocument document = test::triangleDocument();
  document.json["meshes"][0]["primitives"][0]["indices"] =
      test::appendBytes(document, {0, 0, 1, 0, 3, 0}, "SCALAR", 3, 5123);
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { (void)load(document, warnings); });
  EXPECT_NE(message.find("index 2 refers to vertex 3, expected 0..2"), std::string::npos) << message;
  EXPECT_NE(message.find("/indices"), std::string::npos) << message;
}

TEST(LoadMeshes, TextureCoordinatesThatAreNotFinite_AreZeroAndSaidSo) {
  GltfDocument document = test::triangleDocument();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  attributesOf(document)["TEXCOORD_0"] = test::appendFloats(document, {0.25f, 0.5f, nan, 1, 0, 1}, "VEC2");
  Warnings warnings;
  const Scene scene = load(document, warnings);
  const std::vector<glm::vec2>& coords = scene.meshes[0].primitives[0].texCoords0;
  ASSERT_EQ(coords.size(), 3u);
  EXPECT_EQ(coords[0], glm::vec2(0.25f, 0.5f));
  EXPECT_EQ(coords[1], glm::vec2(0.0f));
  EXPECT_TRUE(test::anyContains(warnings, "1 coordinates are not finite"));
}

TEST(LoadMeshes, ColoursBeyondOne_AreClampedAndSaidSo) {
  GltfDocument document = test::triangleDocument();
  attributesOf(document)["COLOR_0"] = test::appendFloats(document, {2, 0.5f, 0, 1, 1, 1, 0, -1, 0}, "VEC3");
  Warnings warnings;
  const Scene scene = load(document, warnings);
  const std::vector<glm::vec4>& colors = scene.meshes[0].primitives[0].colors;
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_EQ(colors[0], glm::vec4(1, 0.5f, 0, 1));
  EXPECT_EQ(colors[2], glm::vec4(0, 0, 0, 1));
  EXPECT_TRUE(test::anyContains(warnings, "2 colours lie outside 0..1"));
}

TEST(LoadNodes, MatrixWithAnotherLastRow_IsTakenAsAffineAndSaidSo) {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"][0]["matrix"] = {2, 0, 0, 0.5, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 4};
  Warnings warnings;
  const Scene scene = load(document, warnings);
  glm::dmat4 expected(2.0);
  expected[3] = glm::dvec4(1, 2, 3, 1);
  EXPECT_EQ(scene.meshNodes.at(0).transforms.at(0), expected);
  EXPECT_TRUE(test::anyContains(warnings, "the last row is not 0 0 0 1"));
}

TEST(LoadNodes, RotatedInstances_AreTurned) {
  GltfDocument document = test::triangleDocument();
  const float half = std::sqrt(0.5f);  // A quarter turn about +Z.
  const int rotations = test::appendFloats(document, {0, 0, 0, 1, 0, 0, half, half}, "VEC4");
  document.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = rotations;
  Warnings warnings;
  const Scene scene = load(document, warnings);
  const std::vector<glm::dmat4>& transforms = scene.meshNodes.at(0).transforms;
  ASSERT_EQ(transforms.size(), 2u);
  EXPECT_EQ(transforms[0], glm::dmat4(1.0));
  const glm::dvec4 turned = transforms[1] * glm::dvec4(1, 0, 0, 0);
  EXPECT_NEAR(glm::length(turned - glm::dvec4(0, 1, 0, 0)), 0.0, 1e-7);
}

TEST(LoadNodes, FlattenedCameraAndLight_LookAlongTheWorldsAxisAndSaySo) {
  GltfDocument document = test::triangleDocument();
  document.json["extensionsUsed"] = {"KHR_lights_punctual"};
  document.json["extensions"] =
      Json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "directional"}]}})");
  document.json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  Json& node = document.json["nodes"][0];
  node["camera"] = 0;
  node["extensions"] = Json::parse(R"({"KHR_lights_punctual": {"light": 0}})");
  node["scale"] = {2, 1, 3};
  const char* warning = "a scale of 0 leaves no direction";
  Warnings warnings;
  (void)load(document, warnings);
  EXPECT_FALSE(test::anyContains(warnings, warning));
  node["scale"] = {1, 1, 0};
  const Scene scene = load(document, warnings);
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [&](const std::string& text) { return text.find(warning) != std::string::npos; }),
            2);
  EXPECT_EQ(glm::dvec3(scene.cameras.at(0).world[2]), glm::dvec3(0, 0, 1));
}

TEST(GltfValidate, IndicesThatAreVectors_AreRefused) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][2]["type"] = "VEC3";
  document.json["accessors"][2]["count"] = 1;
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { (void)test::reload(document, warnings); });
  EXPECT_NE(message.find("expected an accessor of type SCALAR, got VEC3"), std::string::npos) << message;
}

TEST(GltfValidate, MorphTargetOfOtherVertices_IsRefused) {
  GltfDocument document = test::triangleDocument();
  document.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", test::appendFloats(document, {0, 0, 0, 1, 1, 1}, "VEC3")}}};
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { (void)test::reload(document, warnings); });
  EXPECT_NE(message.find("a morph target of 2 vertices for 3"), std::string::npos) << message;
}

TEST(GlbContainer, BytesAfterTheLastChunk_AreRefused) {
  // The header's length includes these bytes, but they are too few for another chunk.
  std::vector<std::uint8_t> bytes = {'g', 'l', 'T', 'F', 2,   0,   0,   0,   28,  0,   0,   0,  // Header.
                                     4,   0,   0,   0,   'J', 'S', 'O', 'N', '{', '}', ' ', ' ', 0, 0, 0, 0};
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { (void)splitGlb(bytes, "stray.glb", warnings); });
  EXPECT_NE(message.find("4 stray bytes after the last chunk"), std::string::npos) << message;
}

}  // namespace
}  // namespace prelight
