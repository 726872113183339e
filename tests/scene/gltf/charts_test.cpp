#include "scene/gltf/charts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "images/picture_codecs.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using test::triangleDocument;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

struct Unfolded {
  Scene scene;
  CompiledScene compiled;
  Charts charts;
  Warnings warnings;
};

Unfolded unfold(const GltfDocument& document, int size = 64) {
  Unfolded result;
  result.scene = loadScene(document, result.warnings);
  result.compiled = compileScene(result.scene, result.warnings);
  result.charts = makeCharts(result.scene, result.compiled, size);
  return result;
}

void setCoords(GltfDocument& document, const char* name, const std::vector<float>& uv) {
  const int accessor = test::appendFloats(document, uv, "VEC2");
  document.json["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
}

/// The triangle of the plane z = 0 with texture coordinates u = x, v = 1 - y, in the orientation of pictures.
GltfDocument unfoldedTriangle() {
  GltfDocument document = triangleDocument();
  setCoords(document, "TEXCOORD_0", {0, 1, 1, 1, 0, 0});
  return document;
}

/// Gives the material a normal map of a single colour.
void setNormalMap(GltfDocument& document, const glm::dvec3& normal, float scale = 1.0f) {
  Image image{"normals", 2, 2, {}};
  for (int texel = 0; texel < 4; ++texel) {
    for (int a = 0; a < 3; ++a)
      image.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (normal[a] + 1.0))));
    image.rgba.push_back(255);
  }
  const int view = appendBufferView(document, encodePng(image));
  document.json["images"] = Json::array({{{"mimeType", "image/png"}, {"bufferView", view}}});
  document.json["textures"] = Json::array({{{"source", 0}}});
  document.json["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", scale}};
}

glm::dvec3 normalOf(const Unfolded& unfolded) {
  const CompiledScene& scene = unfolded.compiled;
  return mappedNormal(scene, unfolded.charts, unfolded.charts.charts.at(0), 0, glm::dvec3(1.0 / 3.0),
                      glm::dvec3(scene.normals[0]));
}

void expectDirection(const glm::dvec3& got, const glm::dvec3& expected) {
  // 8 bits per component leave half a degree.
  EXPECT_LT(glm::length(got - glm::normalize(expected)), 0.01) << got.x << " " << got.y << " " << got.z;
}

TEST(Charts, SecondSet_IsPreferred) {
  GltfDocument document = unfoldedTriangle();
  setCoords(document, "TEXCOORD_1", {0, 0.5f, 0.5f, 0.5f, 0, 0});
  const Unfolded unfolded = unfold(document);
  ASSERT_EQ(unfolded.charts.charts.size(), 1u);
  EXPECT_EQ(unfolded.charts.charts[0].texCoord, 1);
  EXPECT_EQ(unfolded.charts.charts[0].coords[1], glm::vec2(0.5f, 0.5f));
}

TEST(Charts, UnusableSet_GivesWayToTheFirst) {
  GltfDocument document = unfoldedTriangle();
  setCoords(document, "TEXCOORD_1", {0, 3, 3, 3, 0, 0});
  const Unfolded unfolded = unfold(document);
  ASSERT_EQ(unfolded.charts.charts.size(), 1u);
  EXPECT_EQ(unfolded.charts.charts[0].texCoord, 0);
}

TEST(Charts, NoUsableSet_IsLeftOutWithTheReason) {
  EXPECT_THAT(unfold(triangleDocument()).charts.leftOut,
              ::testing::ElementsAre(HasSubstr("TEXCOORD_0 is not there")));
  GltfDocument flat = triangleDocument();
  setCoords(flat, "TEXCOORD_0", {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f});
  EXPECT_THAT(unfold(flat).charts.leftOut, ::testing::ElementsAre(HasSubstr("no area")));
  GltfDocument outside = triangleDocument();
  setCoords(outside, "TEXCOORD_0", {0, 0, 2, 0, 0, 1});
  EXPECT_THAT(unfold(outside).charts.leftOut, ::testing::ElementsAre(HasSubstr("outside 0..1")));
}

TEST(Charts, OverlappingTriangles_AreLeftOut) {
  GltfDocument document = triangleDocument();
  setCoords(document, "TEXCOORD_0", {0, 1, 1, 1, 0, 0});
  document.json["meshes"][0]["primitives"][0]["indices"] =
      test::appendBytes(document, {0, 0, 1, 0, 2, 0, 0, 0, 2, 0, 1, 0}, "SCALAR", 6, 5123);
  EXPECT_THAT(unfold(document).charts.leftOut, ::testing::ElementsAre(HasSubstr("more than once")));
}

TEST(Charts, RoundingBeyondTheSquare_IsMovedToItsBorder) {
  GltfDocument document = triangleDocument();
  setCoords(document, "TEXCOORD_0", {-1e-6f, 1.00001f, 1, 1, 0, 0});
  const Unfolded unfolded = unfold(document);
  ASSERT_EQ(unfolded.charts.charts.size(), 1u);
  EXPECT_EQ(unfolded.charts.charts[0].coords[0], glm::vec2(0, 1));
}

TEST(Charts, SmallerObject_GetsAsManyTexelsAMetre) {
  GltfDocument document = unfoldedTriangle();
  document.json["nodes"].push_back({{"mesh", 0}, {"scale", {0.25, 0.25, 0.25}}});
  document.json["nodes"].push_back({{"mesh", 0}, {"scale", {1e-3, 1e-3, 1e-3}}});
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Unfolded unfolded = unfold(document, 100);
  ASSERT_EQ(unfolded.charts.charts.size(), 3u);
  EXPECT_EQ(unfolded.charts.charts[0].width, 100);
  EXPECT_EQ(unfolded.charts.charts[1].width, 25);
  EXPECT_EQ(unfolded.charts.charts[1].height, 25);
  EXPECT_EQ(unfolded.charts.charts[2].width, leastChartSize);
}

TEST(MappedNormal, WithoutAMap_IsTheShadingNormal) {
  const Unfolded unfolded = unfold(unfoldedTriangle());
  EXPECT_EQ(normalOf(unfolded), glm::dvec3(0, 0, 1));
}

// Red tilts towards growing u, here +X; green tilts towards the upper edge of the picture, +Y.
TEST(MappedNormal, FromTextureCoordinates_LeansAsThePictureLies) {
  GltfDocument document = unfoldedTriangle();
  setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)});
  expectDirection(normalOf(unfold(document)), {0.5, 0.3, std::sqrt(0.66)});
}

TEST(MappedNormal, ScaleOfTheTexture_StretchesXAndY) {
  GltfDocument document = unfoldedTriangle();
  setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)}, 0.5f);
  expectDirection(normalOf(unfold(document)), {0.25, 0.15, std::sqrt(0.66)});
}

TEST(MappedNormal, Tangents_OfTheFileCount) {
  GltfDocument document = unfoldedTriangle();
  setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)});
  document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      test::appendFloats(document, {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4");
  // The bitangent is n x t = -X.
  expectDirection(normalOf(unfold(document)), {-0.3, 0.5, std::sqrt(0.66)});
  document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      test::appendFloats(document, {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, "VEC4");
  expectDirection(normalOf(unfold(document)), {0.3, 0.5, std::sqrt(0.66)});
}

// A mirrored object mirrors its relief, whether or not the file has tangents.
TEST(MappedNormal, MirroredNode_MirrorsTheRelief) {
  for (const bool tangents : {false, true}) {
    GltfDocument document = unfoldedTriangle();
    setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)});
    if (tangents)
      document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
          test::appendFloats(document, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    document.json["nodes"][0]["scale"] = {-1, 1, 1};
    expectDirection(normalOf(unfold(document)), {-0.5, 0.3, std::sqrt(0.66)});
  }
}

TEST(MappedNormal, MirroredCoordinates_StillPointGreenUp) {
  GltfDocument document = triangleDocument();
  setCoords(document, "TEXCOORD_0", {1, 1, 0, 1, 1, 0});  // u = 1 - x.
  setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)});
  expectDirection(normalOf(unfold(document)), {-0.5, 0.3, std::sqrt(0.66)});
}

TEST(MappedNormal, UnreadableTexture_IsAWarningAndNoRelief) {
  GltfDocument document = unfoldedTriangle();
  setNormalMap(document, {0.5, 0.3, std::sqrt(0.66)});
  const auto view = document.json["images"][0]["bufferView"].get<std::size_t>();
  const auto offset = document.json["bufferViews"][view].value("byteOffset", std::size_t{0});
  std::fill_n(document.bin.begin() + static_cast<std::ptrdiff_t>(offset), 16, std::uint8_t{0});
  const Unfolded unfolded = unfold(document);
  EXPECT_FALSE(unfolded.warnings.empty());
  EXPECT_EQ(normalOf(unfolded), glm::dvec3(0, 0, 1));
}

TEST(Charts, TangentWithoutDirection_IsAWarning) {
  GltfDocument document = unfoldedTriangle();
  document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      test::appendFloats(document, {1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
  const Unfolded unfolded = unfold(document);
  EXPECT_TRUE(unfolded.scene.meshes[0].primitives[0].tangents.empty());
  EXPECT_TRUE(test::anyContains(unfolded.warnings, "tangent 1"));
}

}  // namespace
}  // namespace prelight
