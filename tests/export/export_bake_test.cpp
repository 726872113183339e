#include "export/export_bake.h"

#include <gmock/gmock.h>

#include <cstring>
#include <map>
#include <numbers>
#include <set>

#include "export/made_up_bake.h"
#include "images/picture_codecs.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"
#include "support/made_scenes.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;
using test::Baked;
using test::bakedOf;
using test::exported;

/// test::triangleDocument() with a diffuse material, for which light maps are made.
GltfDocument diffuseTriangle() {
  GltfDocument document = test::triangleDocument();
  document.json["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
  return document;
}

std::vector<float> attribute(const GltfDocument& document, const Json& primitive, const char* name) {
  return AccessorReader(document, primitive.at("attributes").at(name).get<std::size_t>()).floats();
}

/// Position and place in the map of every corner of every triangle, sorted.
using Corners = std::vector<std::array<float, 5>>;

Corners cornersOf(const Baked& baked) {
  Corners corners;
  const LightMapLayout& layout = baked.bake.lightMap->layout;
  for (std::uint32_t t = 0; t < baked.compiled.triangleCount(); ++t)
    for (std::size_t c = 0; c < 3 && layout.chartOf[t] != LightMapLayout::noChart; ++c) {
      const glm::dvec3 at =
          baked.compiled.origin +
          glm::dvec3(baked.compiled.positions[baked.compiled.triangles[t][static_cast<int>(c)]]);
      const glm::vec2 place = layout.corners[3 * t + c] / glm::vec2(layout.width, layout.height);
      corners.push_back(
          {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z), place.x, place.y});
    }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Corners as another program reads them from a file: through the nodes' transforms and TEXCOORD_1.
Corners cornersOf(const GltfDocument& document) {
  Warnings warnings;
  const Scene scene = loadScene(document, warnings);
  Corners corners;
  for (const MeshNode& node : scene.meshNodes)
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (primitive.texCoords1.empty()) continue;
      for (const glm::uvec3& triangle : primitive.triangles)
        for (int c = 0; c < 3; ++c) {
          const glm::dvec4 at = node.transforms[0] * glm::dvec4(primitive.positions[triangle[c]], 1.0);
          const glm::vec2 place = primitive.texCoords1[triangle[c]];
          corners.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z),
                             place.x, place.y});
        }
    }
  std::sort(corners.begin(), corners.end());
  return corners;
}

void expectSameCorners(const Corners& got, const Corners& expected) {
  ASSERT_EQ(got.size(), expected.size());
  // Rounding of positions may exchange neighbours in the order, so that the sums of places are compared as
  // well.
  double sum = 0.0, expectedSum = 0.0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    sum += got[i][0] * got[i][3] + 2.0 * got[i][1] * got[i][4];
    expectedSum += expected[i][0] * expected[i][3] + 2.0 * expected[i][1] * expected[i][4];
    for (std::size_t c = 0; c < 5; ++c) wrong += std::abs(got[i][c] - expected[i][c]) > 1e-4f;
  }
  EXPECT_NEAR(sum, expectedSum, 1e-4 * static_cast<double>(got.size()));
  EXPECT_LE(wrong, got.size() / 50);
}

class ExportedCorners : public ::testing::TestWithParam<const char*> {};

TEST_P(ExportedCorners, SecondCoordinates_AreTheMaps) {
  const Baked baked = bakedOf(makeBuiltinScene(GetParam()));
  expectSameCorners(cornersOf(exported(baked, {})), cornersOf(baked));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExportedCorners, ::testing::Values("shapes", "cornell", "rooms", "swing"));

/// A cube of eight vertices: every face is a chart, and every vertex has three places in the map.
GltfDocument cube() {
  GltfDocument document = diffuseTriangle();
  std::vector<float> positions;
  for (int v = 0; v < 8; ++v)
    for (int axis = 0; axis < 3; ++axis) positions.push_back((v >> axis & 1) != 0 ? 1.0f : 0.0f);
  const std::vector<std::uint8_t> triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                               2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  Json& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["attributes"] = {{"POSITION", test::appendFloats(document, positions, "VEC3")}};
  primitive["indices"] = test::appendBytes(document, triangles, "SCALAR", triangles.size(), 5121);
  return document;
}

TEST(ExportBake, VerticesWhereChartsPart_AreSplit) {
  const Baked baked = bakedOf(cube());
  ExportReport report;
  const GltfDocument document = exported(baked, {}, &report);
  EXPECT_EQ(report.meshes.split, 16u) << "24 corners of 8 vertices";
  expectSameCorners(cornersOf(document), cornersOf(baked));
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(attribute(document, primitive, "POSITION").size(), 24u * 3u);
  EXPECT_EQ(attribute(document, primitive, "TEXCOORD_0"), attribute(document, primitive, "TEXCOORD_1"))
      << "sets are numbered without gaps";
}

/// Light of an exported file at the corners of all triangles, read in 8 bits from the picture that the
/// triangle's material names.
struct ShownLight {
  std::map<std::array<float, 2>, double> at;  ///< By place in the map.
  std::set<std::size_t> pictures;
};

ShownLight shownLightOf(const GltfDocument& document) {
  ShownLight shown;
  for (const Json& mesh : document.json["meshes"])
    for (const Json& primitive : mesh["primitives"]) {
      const Json& said =
          document.json["materials"][primitive["material"].get<std::size_t>()]["extensions"]["MOZ_lightmap"];
      const Json& texture = document.json["textures"][said["index"].get<std::size_t>()];
      const auto image = texture["source"].get<std::size_t>();
      const Json& view =
          document.json["bufferViews"][document.json["images"][image]["bufferView"].get<std::size_t>()];
      const Image picture = decodeImage(
          std::span(document.bin)
              .subspan(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>()),
          "map");
      shown.pictures.insert(image);
      const std::vector<float> places = attribute(document, primitive, "TEXCOORD_1");
      for (const std::uint32_t corner :
           AccessorReader(document, primitive["indices"].get<std::size_t>()).unsignedIntegers()) {
        const auto x = static_cast<int>(places[2 * corner] * static_cast<float>(picture.width));
        const auto y = static_cast<int>(places[2 * corner + 1] * static_cast<float>(picture.height));
        const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x);
        shown.at[{places[2 * corner], places[2 * corner + 1]}] =
            said["intensity"].get<double>() * picture.rgba[4 * texel] / 255.0;
      }
    }
  return shown;
}

/// One side of a cube is a hundred times brighter than the others, which belong to the same primitive.
TEST(ExportBake, BrightAndDarkCharts_ShowPicturesWithStepsFineEnoughForEach) {
  Baked baked = bakedOf(cube());
  LightMap& map = *baked.bake.lightMap;
  const auto lightOf = [&](std::uint32_t face) { return map.layout.chartOf[face] == 0 ? 100.0f : 1.0f; };
  for (const LightMapTexel& texel : map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c) map.values[3 * texel.texel + c] = lightOf(texel.face);
  ExportReport report;
  const GltfDocument document = exported(baked, {}, &report);
  expectSameCorners(cornersOf(document), cornersOf(baked));
  EXPECT_EQ(report.mapPictures, 2);
  EXPECT_EQ(report.meshes.parts, 1u);
  const ShownLight shown = shownLightOf(document);
  EXPECT_EQ(shown.pictures.size(), 2u);
  const glm::vec2 size(map.layout.width, map.layout.height);
  for (std::uint32_t face = 0; face < baked.compiled.triangleCount(); ++face)
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec2 place = map.layout.corners[3 * face + c] / size;
      ASSERT_TRUE(shown.at.contains({place.x, place.y}));
      EXPECT_NEAR(shown.at.at({place.x, place.y}), lightOf(face), 0.005 * lightOf(face));
    }
}

TEST(ExportBake, TwoNodesOfAMesh_GetMeshesOfTheirOwn) {
  GltfDocument scene = cube();
  scene.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}, {"translation", {3, 0, 0}}});
  scene.json["scenes"][0]["nodes"].push_back(1);
  const Baked baked = bakedOf(scene);
  const GltfDocument document = exported(baked, {});
  EXPECT_EQ(document.json["meshes"].size(), 2u);
  EXPECT_NE(document.json["nodes"][0]["mesh"], document.json["nodes"][1]["mesh"]);
  EXPECT_EQ(document.json["nodes"][1]["name"], "other");
  expectSameCorners(cornersOf(document), cornersOf(baked));
}

TEST(ExportBake, Instances_BecomeNodes) {
  GltfDocument scene = cube();
  const int places = test::appendFloats(scene, {0, 0, 0, 5, 0, 0, 0, 0, 7}, "VEC3");
  scene.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  scene.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const Baked baked = bakedOf(scene);
  const GltfDocument document = exported(baked, {});
  EXPECT_FALSE(document.json["nodes"][0].contains("mesh"));
  EXPECT_EQ(document.json["nodes"][0]["children"].size(), 3u);
  EXPECT_EQ(document.json["nodes"][2]["name"], "node 2");
  EXPECT_EQ(document.json.dump().find("EXT_mesh_gpu_instancing"), std::string::npos);
  expectSameCorners(cornersOf(document), cornersOf(baked));
}

TEST(ExportBake, BothSidesLit_TheBackIsAPrimitiveThatFacesTheOtherWay) {
  GltfDocument scene = diffuseTriangle();
  scene.json["materials"][0]["doubleSided"] = true;
  ExportReport report;
  const GltfDocument document = exported(bakedOf(scene), {}, &report);
  EXPECT_EQ(report.meshes.backs, 1u);
  const Json& primitives = document.json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_EQ(attribute(document, primitives[0], "NORMAL")[2], 1.0f);
  EXPECT_EQ(attribute(document, primitives[1], "NORMAL")[2], -1.0f);
  EXPECT_EQ(AccessorReader(document, primitives[1]["indices"].get<std::size_t>()).unsignedIntegers(),
            (std::vector<std::uint32_t>{0, 2, 1}));
  EXPECT_NE(attribute(document, primitives[0], "TEXCOORD_1"),
            attribute(document, primitives[1], "TEXCOORD_1"));
  for (const Json& primitive : primitives)
    EXPECT_FALSE(
        document.json["materials"][primitive["material"].get<std::size_t>()].contains("doubleSided"));
}

/// Whether all triangles of an exported primitive, and its normals, look towards a point (or away from it).
bool looksTowards(const GltfDocument& document, const Json& primitive, const glm::vec3& point, bool away) {
  const std::vector<float> positions = attribute(document, primitive, "POSITION"),
                           normals = attribute(document, primitive, "NORMAL");
  const auto at = [](const std::vector<float>& values, std::uint32_t v) {
    return glm::vec3(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
  };
  const std::vector<std::uint32_t> indices =
      AccessorReader(document, primitive.at("indices").get<std::size_t>()).unsignedIntegers();
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const glm::vec3 a = at(positions, indices[i]);
    const glm::vec3 facing = glm::cross(at(positions, indices[i + 1]) - a, at(positions, indices[i + 2]) - a);
    if ((glm::dot(facing, point - a) > 0.0f) == away) return false;
    if (glm::dot(facing, at(normals, indices[i])) <= 0.0f) return false;
  }
  return !indices.empty();
}

TEST(ExportBake, TrianglesWoundAgainstTheirNormals_AreWrittenAsTheNormalsTell) {
  const glm::vec3 middle(0.0f, 1.0f, 0.0f);
  const LoadedScene scene =
      test::SceneMaker().add("ball", test::woundBack(test::sphere(8, 1.0f, middle))).make();
  for (const ExportForm form : {ExportForm::LightMap, ExportForm::VertexLight}) {
    ExportRequest request;
    request.form = form;
    const GltfDocument document = exported(bakedOf(*scene.document), request);
    const Json& primitives = document.json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 1u);
    EXPECT_TRUE(looksTowards(document, primitives[0], middle, true));
  }
}

TEST(ExportBake, RoomSeenFromBehind_IsThereOnBothSides) {
  const glm::vec3 middle(0.0f, 1.5f, 0.0f);
  const LoadedScene scene = test::SceneMaker()
                                .add("room", test::box(4, {-2, 0, -2}, {2, 3, 2}, false))
                                .addLamp({1.0, 2.0, 1.0})
                                .addCamera({1.5, 1.0, 1.5})
                                .make();
  const GltfDocument map = exported(bakedOf(*scene.document), {});
  const Json& sides = map.json["meshes"][0]["primitives"];
  ASSERT_EQ(sides.size(), 2u);
  EXPECT_TRUE(looksTowards(map, sides[0], middle, false));
  EXPECT_TRUE(looksTowards(map, sides[1], middle, true));
  ExportRequest request;
  request.form = ExportForm::VertexLight;
  const GltfDocument lit = exported(bakedOf(*scene.document), request);
  const Json& primitive = lit.json["meshes"][0]["primitives"][0];
  EXPECT_TRUE(looksTowards(lit, primitive, middle, false));
  EXPECT_EQ(lit.json["materials"][primitive["material"].get<std::size_t>()]["doubleSided"], true);
}

TEST(ExportBake, MaterialThatUsesTheSecondSet_LeavesItAndTakesTheThird) {
  GltfDocument scene = diffuseTriangle();
  const std::vector<float> coords = {0.25f, 0.5f, 0.75f, 0.5f, 0.25f, 0.875f};
  Json& attributes = scene.json["meshes"][0]["primitives"][0]["attributes"];
  const int accessor = test::appendFloats(scene, coords, "VEC2");
  attributes["TEXCOORD_0"] = accessor;
  attributes["TEXCOORD_1"] = accessor;
  scene.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
  scene.json["textures"] = Json::array({Json::object()});
  const GltfDocument document = exported(bakedOf(scene), {});
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(attribute(document, primitive, "TEXCOORD_1"), coords);
  EXPECT_NE(attribute(document, primitive, "TEXCOORD_2"), coords);
  EXPECT_EQ(document.json["materials"][0]["extensions"]["MOZ_lightmap"]["texCoord"], 2);
}

TEST(ExportBake, Materials_KeepTheirPlacesAndLamps_HaveNoMap) {
  const Baked baked = bakedOf(makeBuiltinScene("cornell"));
  const GltfDocument document = exported(baked, {});
  const Json &before = baked.document.json["materials"], &after = document.json["materials"];
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i]["name"], before[i]["name"]);
    const bool mapped = after[i].contains(Json::json_pointer("/extensions/MOZ_lightmap"));
    EXPECT_NE(mapped, after[i].contains("emissiveFactor")) << after[i]["name"];
  }
}

TEST(ExportBake, OwnExtension_IsGone) {
  const GltfDocument document = exported(bakedOf(makeBuiltinScene("cornell")), {});
  EXPECT_EQ(document.json.dump().find("PRELIGHT_transfer"), std::string::npos);
}

TEST(ExportBake, WhatNothingRefersTo_IsNotWritten) {
  const GltfDocument document = exported(bakedOf(cube()), {});
  // Positions, indices and coordinates have accessors; the picture's bytes have none.
  EXPECT_EQ(document.json["accessors"].size(), 3u);
  EXPECT_EQ(document.json["bufferViews"].size(), 4u);
}

TEST(ExportBake, VertexLight_IsIrradianceOverPi) {
  const Baked baked = bakedOf(makeBuiltinScene("shapes"));
  ExportRequest request;
  request.form = ExportForm::VertexLight;
  ExportReport report;
  const GltfDocument document = exported(baked, request, &report);
  EXPECT_NEAR(report.meshes.colorScale, 2.0f * std::numbers::inv_pi_v<float>, 1e-6f);
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  for (const float value : attribute(document, primitive, "COLOR_0")) EXPECT_FLOAT_EQ(value, 1.0f);
  const Json& material = document.json["materials"][primitive["material"].get<std::size_t>()];
  EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(report.lights, 1u);
  EXPECT_FALSE(document.json.contains("extensions")) << "the lamp is in the colours";
}

TEST(ExportBake, VertexLightOfLamps_ShowsWhatTheySendAndReflect) {
  GltfDocument scene = makeBuiltinScene("cornell");
  for (Json& material : scene.json["materials"]) {
    if (!material.contains("emissiveFactor")) continue;
    material.erase("extensions");
    material["emissiveFactor"] = {0.0, 0.1, 0.2};
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1.0};
  }
  ExportRequest request;
  request.form = ExportForm::VertexLight;
  ExportReport report;
  const GltfDocument document = exported(bakedOf(std::move(scene)), request, &report);
  const float scale = report.meshes.colorScale;
  const float reflected = std::min(0.5f * 2.0f * std::numbers::inv_pi_v<float> / scale, 1.0f);
  int lamps = 0;
  for (const Json& mesh : document.json["meshes"]) {
    const Json& primitive = mesh["primitives"][0];
    const Json& material = document.json["materials"][primitive["material"].get<std::size_t>()];
    if (!material.contains("emissiveFactor")) continue;
    ++lamps;
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], Json({1.0, 1.0, 1.0, 1.0}));
    const std::vector<float> colors = attribute(document, primitive, "COLOR_0");
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(colors[i], std::min(reflected + 0.1f * static_cast<float>(i) / scale, 1.0f), 1e-5f) << i;
  }
  EXPECT_EQ(lamps, 1);
}

TEST(ExportBake, VertexOcclusion_IsThatOfTheBakeAndLightsStay) {
  const Baked baked = bakedOf(makeBuiltinScene("shapes"));
  ExportRequest request;
  request.form = ExportForm::VertexOcclusion;
  const GltfDocument document = exported(baked, request);
  const std::vector<float> colors =
      attribute(document, document.json["meshes"][0]["primitives"][0], "COLOR_0");
  for (std::size_t v = 0; v < colors.size() / 4; ++v) EXPECT_FLOAT_EQ(colors[4 * v], baked.bake.ao[v]);
  EXPECT_TRUE(document.json["extensions"].contains("KHR_lights_punctual"));
}

TEST(ExportBake, Occlusion_IsATextureOnTheChartsCoordinates) {
  const Baked baked = bakedOf(makeBuiltinScene("cornell"));
  ExportRequest request;
  request.form = ExportForm::Occlusion;
  const GltfDocument document = exported(baked, request);
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  const Json& material = document.json["materials"][primitive["material"].get<std::size_t>()];
  EXPECT_EQ(material["occlusionTexture"]["texCoord"], 1);
  const Json& texture = document.json["textures"][material["occlusionTexture"]["index"].get<std::size_t>()];
  const Json& image = document.json["images"][texture["source"].get<std::size_t>()];
  const auto view = image["bufferView"].get<std::size_t>();
  const auto offset = document.json["bufferViews"][view]["byteOffset"].get<std::size_t>();
  EXPECT_EQ(std::string(&document.bin[offset + 1], &document.bin[offset + 4]), "PNG");
  const int width = document.bin[offset + 18] << 8 | document.bin[offset + 19];
  EXPECT_GT(width, 32);
}

TEST(ExportBake, FormThatTheBakeDoesNotHold_IsRefusedAndNothingWritten) {
  Baked baked = bakedOf(makeBuiltinScene("shapes"));
  baked.bake = {};
  for (const ExportForm form :
       {ExportForm::LightMap, ExportForm::Occlusion, ExportForm::VertexLight, ExportForm::VertexOcclusion}) {
    const test::TemporaryFolder folder;
    ExportRequest request;
    request.form = form;
    EXPECT_THROW(
        exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out", request),
        UsageError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(ExportBake, Folder_HoldsWhatItsDescriptionNames) {
  const Baked baked = bakedOf(makeBuiltinScene("shapes"));
  for (const ExportTarget target : {ExportTarget::Gltf, ExportTarget::Three, ExportTarget::Blender,
                                    ExportTarget::Raw, ExportTarget::Godot, ExportTarget::Unity}) {
    const test::TemporaryFolder folder;
    ExportRequest request;
    request.target = target;
    exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out", request);
    const Json description = Json::parse(test::readBytes(folder / "out.export.json"));
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename().string();
      EXPECT_THAT(description["files"].dump(), HasSubstr("\"" + name + "\""));
      ++files;
    }
    EXPECT_EQ(files, description["files"].size());
    const std::string readme = test::readBytes(folder / "README.md");
    EXPECT_THAT(readme, HasSubstr("out.glb"));
    for (const char* mark : {"NAME", "HELD", "FILES", "LIGHTS", "DIRECTION", "SKY"})
      EXPECT_EQ(readme.find('{' + std::string(mark)), std::string::npos) << "all marks are filled in";
  }
}

/// Adds light from straight above with the map's own irradiance, as incident radiance in SH of order 2.
Baked withDirections(Baked baked) {
  LightMap& map = *baked.bake.lightMap;
  const std::vector<float> irradiance = map.values;
  map.coefficients = 5;
  map.values.clear();
  for (const float e : irradiance)
    for (const double share : {1.0, 0.28209479, 0.48860251, 0.0, 0.0})
      map.values.push_back(static_cast<float>(share) * e);
  return baked;
}

TEST(ExportBake, Directions_AreWrittenForTheTargetsThatReadThem) {
  const Baked baked = withDirections(bakedOf(makeBuiltinScene("shapes")));
  for (const ExportTarget target :
       {ExportTarget::Gltf, ExportTarget::Three, ExportTarget::Godot, ExportTarget::Unity}) {
    const test::TemporaryFolder folder;
    ExportRequest request;
    request.target = target;
    exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out", request);
    const bool web = target == ExportTarget::Gltf || target == ExportTarget::Three;
    EXPECT_EQ(std::filesystem::exists(folder / "out.lightmap.sh.l1m-1.ktx2"), web);
    EXPECT_EQ(std::filesystem::exists(folder / "out.lightmap.direction.png"),
              target == ExportTarget::Gltf || target == ExportTarget::Unity);
    EXPECT_EQ(test::readBytes(folder / "README.md").find("bumpedIrradiance") != std::string::npos,
              target != ExportTarget::Godot);
    EXPECT_NE(test::readBytes(folder / "out.lightmap.exr").find("sh.l1m-1.G"), std::string::npos);
  }
}

TEST(ExportBake, Transfer_LeavesTheSceneAsItIs) {
  Baked baked = bakedOf(makeBuiltinScene("shapes"));
  baked.bake.lightMap.reset();
  baked.bake.irradiance.reset();
  baked.bake.ao.clear();
  ExportRequest request{ExportTarget::Raw, ExportForm::Transfer, BakedLights::Remove};
  const test::TemporaryFolder folder;
  const auto run = [&] {
    exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out", request);
  };
  EXPECT_THROW(run(), UsageError) << "nothing was baked";
  baked.bake.sh = HarmonicTransfer{1, 1, 0, std::vector<float>(baked.compiled.vertexCount(), 0.25f)};
  run();
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "out.glb", warnings);
  EXPECT_EQ(document.json["meshes"], baked.document.json["meshes"]);
  EXPECT_EQ(document.json["materials"], baked.document.json["materials"]);
  EXPECT_EQ(document.json["extensions"], baked.document.json["extensions"]);
  EXPECT_TRUE(std::filesystem::exists(folder / "relight.py"));
  EXPECT_THAT(test::readBytes(folder / "README.md"), HasSubstr("relight.py"));
  const Json description = Json::parse(test::readBytes(folder / "out.vertices.json"));
  EXPECT_EQ(description["arrays"]["sh"]["shape"], Json({baked.compiled.vertexCount(), 1, 1}));
}

/// For three.js the scene stays as it is, with the parts of its bake that prelight.js relights.
TEST(ExportBake, TransferForThree_KeepsWhatTheModuleRelights) {
  Baked baked = bakedOf(makeBuiltinScene("shapes"));
  const ExportRequest request{ExportTarget::Three, ExportForm::Transfer, BakedLights::Remove};
  const test::TemporaryFolder folder;
  const auto run = [&] {
    return exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out",
                      request);
  };
  EXPECT_THROW(run(), UsageError) << "AO and light maps alone are not transfer";
  const std::size_t vertices = baked.compiled.vertexCount();
  baked.bake.sh = HarmonicTransfer{2, 1, 0, std::vector<float>(4 * vertices, 0.25f)};
  const ExportReport report = run();
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "out.glb", warnings);
  EXPECT_EQ(document.json["meshes"], baked.document.json["meshes"]);
  EXPECT_EQ(document.json["materials"], baked.document.json["materials"]);
  const Json entry = document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0];
  EXPECT_EQ(entry["sh"]["order"], 2);
  EXPECT_FALSE(entry.contains("ao") || entry.contains("lightmap") || entry.contains("irradiance"));
  EXPECT_THAT(test::readBytes(folder / "prelight.js"), HasSubstr("class Relighter"));
  EXPECT_THAT(test::readBytes(folder / "index.html"), HasSubstr("'out.glb'"));
  const std::string readme = test::readBytes(folder / "README.md");
  EXPECT_THAT(readme, HasSubstr("Relighter.load("));
  EXPECT_THAT(readme, HasSubstr("inside `out.glb`"));
  EXPECT_THAT(readme, Not(HasSubstr("as numbers")));
  ASSERT_EQ(report.contents.taken.size(), 1u);
  EXPECT_THAT(report.contents.taken[0].what, HasSubstr("SH of order 2"));
  EXPECT_EQ(report.contents.leftOut.size(), 3u) << "AO, irradiance and the light map";
}

TEST(ExportBake, NamesWithQuotesAndMarks_AreWrittenAsHtmlAndUrlsHaveThem) {
  Baked baked = bakedOf(makeBuiltinScene("shapes"));
  baked.bake.sh = HarmonicTransfer{1, 1, 0, std::vector<float>(baked.compiled.vertexCount(), 0.25f)};
  const test::TemporaryFolder folder;
  exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "l'atelier <&> 50%",
             {ExportTarget::Three, ExportForm::Transfer, BakedLights::Remove});
  const std::string page = test::readBytes(folder / "index.html");
  EXPECT_THAT(page, HasSubstr("<title>l'atelier &lt;&amp;> 50%</title>"));
  EXPECT_THAT(page, HasSubstr("loadAsync('l%27atelier%20%3C%26%3E%2050%25.glb')"));
  EXPECT_THAT(test::readBytes(folder / "README.md"),
              HasSubstr("loadAsync('l%27atelier%20%3C%26%3E%2050%25.glb')"));
}

/// Each part of a bake is either in an export or named among those that are not.
TEST(ExportBake, Contents_NameEachPartOnce) {
  Baked baked = bakedOf(makeBuiltinScene("shapes"));
  const std::size_t vertices = baked.compiled.vertexCount();
  baked.bake.sh = HarmonicTransfer{2, 1, 0, std::vector<float>(4 * vertices, 0.25f)};
  const std::size_t all = 4;  // light map, AO, irradiance, SH
  for (const ExportTarget target : {ExportTarget::Gltf, ExportTarget::Three, ExportTarget::Blender,
                                    ExportTarget::Godot, ExportTarget::Unity}) {
    const ExportedContents contents = exportedContents(baked.bake, vertices, {target, ExportForm::LightMap});
    ASSERT_EQ(contents.taken.size(), 1u);
    EXPECT_THAT(contents.taken[0].what, HasSubstr("light map"));
    EXPECT_EQ(contents.leftOut.size(), all - 1);
    EXPECT_THAT(toJson(contents)["leftOut"].dump(), HasSubstr(R"({"as":"transfer","target":"three"})"));
  }
  const ExportedContents numbers =
      exportedContents(baked.bake, vertices, {ExportTarget::Raw, ExportForm::LightMap});
  EXPECT_EQ(numbers.taken.size(), all) << "numbers of vertices are beside the map";
  EXPECT_EQ(exportedContents(baked.bake, vertices, {ExportTarget::Raw, ExportForm::Transfer}).taken.size(),
            all - 1);
}

TEST(ExportBake, Raw_HoldsWhatWasBakedOfVertices) {
  const Baked baked = bakedOf(makeBuiltinScene("shapes"));
  const test::TemporaryFolder folder;
  ExportRequest request;
  request.target = ExportTarget::Raw;
  exportBake({baked.document, baked.scene, baked.compiled, baked.bake}, folder.path(), "out", request);
  const Json description = Json::parse(test::readBytes(folder / "out.vertices.json"));
  const std::string bytes = test::readBytes(folder / "out.vertices.bin");
  const std::size_t at = description["arrays"]["ao"]["byteOffset"].get<std::size_t>();
  float ao = 0.0f;
  std::memcpy(&ao, &bytes.at(at + 4 * sizeof(float)), sizeof(float));
  EXPECT_EQ(ao, baked.bake.ao[4]);
  std::size_t vertices = 0;
  for (const Json& primitive : description["primitives"]) {
    EXPECT_EQ(primitive["firstVertex"], vertices);
    vertices += primitive["vertexCount"].get<std::size_t>();
  }
  EXPECT_EQ(vertices, baked.compiled.vertexCount());
  EXPECT_EQ(description["arrays"]["irradiance"]["shape"], Json({vertices, 3}));
}

}  // namespace
}  // namespace prelight
