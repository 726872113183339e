#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/gltf_files.h"

namespace prelight {
namespace {

using test::appendBytes;
using test::appendFloats;
using test::triangleDocument;
using Triangles = std::vector<glm::uvec3>;

nlohmann::ordered_json& primitiveOf(GltfDocument& document) {
  return document.json["meshes"][0]["primitives"][0];
}

Primitive loadPrimitive(const GltfDocument& document, Warnings& warnings) {
  return test::reload(document, warnings).meshes[0].primitives[0];
}

Primitive loadPrimitive(const GltfDocument& document) {
  Warnings warnings;
  return loadPrimitive(document, warnings);
}

/// Five vertices in a strip along x.
GltfDocument stripDocument(int mode) {
  GltfDocument document = triangleDocument();
  const int positions = appendFloats(document, {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, "VEC3");
  primitiveOf(document) = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
  return document;
}

TEST(LoadMesh, TriangleStrip_AlternatesWinding) {
  EXPECT_EQ(loadPrimitive(stripDocument(5)).triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(LoadMesh, TriangleFan_SharesItsFirstVertex) {
  EXPECT_EQ(loadPrimitive(stripDocument(6)).triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(LoadMesh, ListWithRemainder_DropsItWithAWarning) {
  Warnings warnings;
  EXPECT_EQ(loadPrimitive(stripDocument(4), warnings).triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadMesh, PointsAndLines_StayAsEmptyPrimitives) {
  for (int mode = 0; mode < 4; ++mode) {
    GltfDocument document = triangleDocument();
    auto& primitives = document.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["mode"] = mode;
    Warnings warnings;
    const Scene scene = test::reload(document, warnings);
    ASSERT_EQ(scene.meshes[0].primitives.size(), 2u);
    EXPECT_TRUE(scene.meshes[0].primitives[0].triangles.empty());
    EXPECT_EQ(scene.meshes[0].primitives[1].triangles.size(), 1u);
    EXPECT_EQ(warnings.size(), 1u);
  }
}

TEST(LoadMesh, IndicesOf8And32Bits_Load) {
  GltfDocument document = triangleDocument();
  primitiveOf(document)["indices"] = appendBytes(document, {2, 1, 0}, "SCALAR", 3, 5121);
  EXPECT_EQ(loadPrimitive(document).triangles, (Triangles{{2, 1, 0}}));
  primitiveOf(document)["indices"] =
      appendBytes(document, {1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "SCALAR", 3, 5125);
  EXPECT_EQ(loadPrimitive(document).triangles, (Triangles{{1, 2, 0}}));
}

TEST(LoadMesh, SparseOverBufferAndOverZeros_Substitutes) {
  GltfDocument document = triangleDocument();
  const int values = appendFloats(document, {5, 6, 7}, "VEC3");
  const int indices = appendBytes(document, {1}, "SCALAR", 1, 5121);
  const auto& accessors = document.json["accessors"];
  const nlohmann::ordered_json sparse = {
      {"count", 1},
      {"indices",
       {{"bufferView", accessors[static_cast<std::size_t>(indices)]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", accessors[static_cast<std::size_t>(values)]["bufferView"]}}}};
  document.json["accessors"][0]["sparse"] = sparse;
  EXPECT_EQ(loadPrimitive(document).positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
  document.json["accessors"][0].erase("bufferView");
  EXPECT_EQ(loadPrimitive(document).positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}}));
}

TEST(LoadMesh, InterleavedStride_IsHonoured) {
  GltfDocument document = triangleDocument();
  appendFloats(document, {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}, "VEC3");
  auto& json = document.json;
  json["bufferViews"].back()["byteStride"] = 24;
  json["accessors"][3]["count"] = 3;
  json["accessors"].push_back(json["accessors"][3]);
  json["accessors"][4]["byteOffset"] = 12;
  primitiveOf(document)["attributes"] = {{"POSITION", 3}, {"NORMAL", 4}};
  const Primitive primitive = loadPrimitive(document);
  EXPECT_EQ(primitive.positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(primitive.normals[2], glm::vec3(0, 0, 1));
}

TEST(LoadMesh, QuantizedAttributes_Dequantise) {
  GltfDocument document = triangleDocument();
  document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  // Signed bytes padded to 4: positions are not normalised; normals are normalised and shorter than unit
  // length.
  appendBytes(document, {0, 0, 0, 0, 10, 0, 0, 0, 0, 0x80, 0, 0}, "VEC3", 3, 5120);
  document.json["bufferViews"].back()["byteStride"] = 4;
  appendBytes(document, {0, 0, 120, 0, 0, 0, 127, 0, 0, 0, 0x80, 0}, "VEC3", 3, 5120);
  document.json["bufferViews"].back()["byteStride"] = 4;
  document.json["accessors"][4]["normalized"] = true;
  appendBytes(document, {0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0x80, 0, 0}, "VEC2", 3, 5123);
  document.json["accessors"][5]["normalized"] = true;
  primitiveOf(document)["attributes"] = {{"POSITION", 3}, {"NORMAL", 4}, {"TEXCOORD_0", 5}};
  const Primitive primitive = loadPrimitive(document);
  EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{0, 0, 0}, {10, 0, 0}, {0, -128, 0}}));
  EXPECT_EQ(primitive.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, -1}}));
  EXPECT_EQ(primitive.texCoords0[0], glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(primitive.texCoords0[2].x, 32768.0f / 65535.0f);
}

TEST(LoadMesh, NonFinitePosition_ThrowsNamingTheVertex) {
  GltfDocument document = triangleDocument();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  primitiveOf(document)["attributes"]["POSITION"] =
      appendFloats(document, {0, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3");
  const std::string message = test::inputErrorOf([&] { loadPrimitive(document); });
  EXPECT_NE(message.find("/meshes/0/primitives/0/attributes/POSITION: vertex 1"), std::string::npos)
      << message;
}

TEST(LoadMesh, ZeroAndNanNormals_BecomeGeometricWithAWarning) {
  GltfDocument document = triangleDocument();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  primitiveOf(document)["attributes"]["NORMAL"] =
      appendFloats(document, {0, 0, 0, nan, 0, 0, 0, 3, 0}, "VEC3");
  Warnings warnings;
  const Primitive primitive = loadPrimitive(document, warnings);
  EXPECT_EQ(primitive.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 normals"), std::string::npos);
}

TEST(LoadMesh, ColorsOfThreeBytes_AreNormalisedWithAlphaOne) {
  GltfDocument document = triangleDocument();
  appendBytes(document, {255, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3, 5121);
  document.json["bufferViews"].back()["byteStride"] = 4;
  primitiveOf(document)["attributes"]["COLOR_0"] = 3;
  const Primitive primitive = loadPrimitive(document);
  EXPECT_EQ(primitive.colors[0], glm::vec4(1.0f, 0.0f, 0.2f, 1.0f));
}

TEST(LoadMesh, NoPosition_WarnsAndStaysEmpty) {
  GltfDocument document = triangleDocument();
  primitiveOf(document)["attributes"].erase("POSITION");
  Warnings warnings;
  EXPECT_TRUE(loadPrimitive(document, warnings).triangles.empty());
  EXPECT_TRUE(test::anyContains(warnings, "no POSITION"));
}

}  // namespace
}  // namespace prelight
