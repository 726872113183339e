#include "refine/refined_document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf/accessor.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

/// The triangle of test::triangleDocument(), cut in the middle of the edge from vertex 0 to vertex 1.
std::vector<RefinedPrimitive> halves() {
  return {{0, 0, {{0u, 1u}}, {glm::uvec3(0, 3, 2), glm::uvec3(3, 1, 2)}}};
}

Primitive primitiveOf(const GltfDocument& document) {
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(warnings.empty());
  return scene.meshes.at(0).primitives.at(0);
}

nlohmann::ordered_json& attributesOf(GltfDocument& document) {
  return document.json["meshes"][0]["primitives"][0]["attributes"];
}

TEST(RefinedDocument, PositionsAndTriangles_AreCut) {
  GltfDocument document = test::triangleDocument();
  writeRefined(halves(), document);
  const Primitive primitive = primitiveOf(document);
  ASSERT_EQ(primitive.positions.size(), 4u);
  EXPECT_EQ(primitive.positions[3], glm::vec3(0.5f, 0.0f, 0.0f));
  EXPECT_EQ(primitive.triangles, (std::vector<glm::uvec3>{{0, 3, 2}, {3, 1, 2}}));
}

TEST(RefinedDocument, Attributes_AreMeans) {
  GltfDocument document = test::triangleDocument();
  attributesOf(document)["TEXCOORD_0"] = test::appendFloats(document, {0, 0, 1, 0.5f, 0, 1}, "VEC2");
  attributesOf(document)["COLOR_0"] =
      test::appendBytes(document, {0, 0, 0, 255, 255, 51, 0, 255, 0, 0, 0, 255}, "VEC4", 3, 5121);
  document.json["accessors"].back()["normalized"] = true;
  attributesOf(document)["NORMAL"] = test::appendFloats(document, {0, 0, 1, 1, 0, 0, 0, 0, 1}, "VEC3");
  writeRefined(halves(), document);
  const Primitive primitive = primitiveOf(document);
  EXPECT_EQ(primitive.texCoords0.at(3), glm::vec2(0.5f, 0.25f));
  EXPECT_NEAR(primitive.colors.at(3).x, 0.5f, 1e-6f);
  EXPECT_NEAR(primitive.colors.at(3).y, 0.1f, 1e-6f);
  const float root = std::sqrt(0.5f);
  EXPECT_NEAR(primitive.normals.at(3).x, root, 1e-6f);
  EXPECT_NEAR(primitive.normals.at(3).z, root, 1e-6f);
}

TEST(RefinedDocument, MorphTargets_AreMeansOfChanges) {
  GltfDocument document = test::triangleDocument();
  document.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", test::appendFloats(document, {0, 0, 2, 0, 0, 4, 0, 0, 0}, "VEC3")},
       {"NORMAL", test::appendFloats(document, {0, 0, 0, 0.5f, 0, 0, 0, 0, 0}, "VEC3")}}};
  writeRefined(halves(), document);
  const Primitive primitive = primitiveOf(document);
  ASSERT_EQ(primitive.targets.size(), 1u);
  EXPECT_EQ(primitive.targets[0].positions.at(3), glm::vec3(0, 0, 3));
  EXPECT_EQ(primitive.targets[0].normals.at(3), glm::vec3(0.25f, 0, 0));
}

TEST(RefinedDocument, Joints_AreThoseOfBothVertices) {
  GltfDocument document = test::triangleDocument();
  attributesOf(document)["JOINTS_0"] =
      test::appendBytes(document, {0, 1, 0, 0, 2, 3, 4, 0, 0, 0, 0, 0}, "VEC4", 3, 5121);
  attributesOf(document)["WEIGHTS_0"] =
      test::appendFloats(document, {0.5f, 0.5f, 0, 0, 0.5f, 0.375f, 0.125f, 0, 1, 0, 0, 0}, "VEC4");
  writeRefined(halves(), document);
  const Primitive primitive = primitiveOf(document);
  // The fifth joint, of the smallest mean weight, has no room.
  EXPECT_EQ(std::vector<std::uint32_t>(primitive.joints.begin() + 12, primitive.joints.end()),
            (std::vector<std::uint32_t>{0, 1, 2, 3}));
  const float sum = 0.25f + 0.25f + 0.25f + 0.1875f;
  EXPECT_NEAR(primitive.jointWeights.at(12), 0.25f / sum, 1e-6f);
  EXPECT_NEAR(primitive.jointWeights.at(15), 0.1875f / sum, 1e-6f);
}

TEST(RefinedDocument, Identifiers_AreNotMixed) {
  GltfDocument document = test::triangleDocument();
  attributesOf(document)["_FEATURE_ID_0"] = test::appendBytes(document, {7, 9, 9}, "SCALAR", 3, 5121);
  writeRefined(halves(), document);
  const AccessorReader ids(document, attributesOf(document)["_FEATURE_ID_0"].get<std::size_t>());
  EXPECT_EQ(ids.unsignedIntegers(), (std::vector<std::uint32_t>{7, 9, 9, 7}));
}

/// Files may have identifiers as floats, too.
TEST(RefinedDocument, FloatIdentifiers_AreNotMixed) {
  GltfDocument document = test::triangleDocument();
  attributesOf(document)["_FEATURE_ID_0"] = test::appendFloats(document, {7, 9, 9}, "SCALAR");
  writeRefined(halves(), document);
  const AccessorReader ids(document, attributesOf(document)["_FEATURE_ID_0"].get<std::size_t>());
  EXPECT_EQ(ids.floats(), (std::vector<float>{7, 9, 9, 7}));
}

TEST(RefinedDocument, Accessors_KeepTheirNamesAndExtras) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0]["name"] = "places";
  document.json["accessors"][0]["extras"] = {{"from", "a test"}};
  writeRefined(halves(), document);
  const auto& accessor = document.json["accessors"][attributesOf(document)["POSITION"].get<std::size_t>()];
  EXPECT_EQ(accessor["name"], "places");
  EXPECT_EQ(accessor["extras"]["from"], "a test");
}

TEST(RefinedDocument, Nothing_LeavesTheBytes) {
  GltfDocument document = test::triangleDocument();
  const auto json = document.json;
  const auto bin = document.bin;
  writeRefined({}, document);
  EXPECT_EQ(document.json, json);
  EXPECT_EQ(document.bin, bin);
}

}  // namespace
}  // namespace prelight
