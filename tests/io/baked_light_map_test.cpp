#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "io/baked_file.h"
#include "prelight/picture.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/settle_sides.h"
#include "support/gltf_files.h"
#include "support/made_scenes.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A scene with a light map of made-up values, written and read again.
struct WrittenLightMap {
  fs::path folder, file;
  Scene scene;
  CompiledScene compiled;
  LightMap map;
};

WrittenLightMap write(GltfDocument document, int coefficients = 1, double texelSize = 0.0) {
  WrittenLightMap written;
  written.folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(written.folder);
  written.file = written.folder / "room with #1.glb";
  Warnings warnings;
  written.scene = loadScene(document, warnings);
  written.compiled = settleSides(written.scene, warnings);
  LightMapLayoutRequest request;
  request.texels = 4096;
  request.texelSize = texelSize;
  written.map.layout = makeLightMapLayout(written.scene, written.compiled, request);
  written.map.coefficients = coefficients;
  written.map.values.assign(3 * std::size_t(coefficients) * written.map.layout.texelCount(), 0.0f);
  for (std::size_t i = 0; i < written.map.values.size(); ++i)
    written.map.values[i] = 0.25f * static_cast<float>(i % 1013);
  Bake bake;
  bake.ao.assign(written.compiled.vertexCount(), 0.5f);
  bake.bentNormals.assign(written.compiled.vertexCount(), {0, 1, 0});
  embedBake(document, written.compiled, bake);
  const fs::path picture = lightMapPath(written.file);
  embedLightMap(document, written.compiled, written.map.layout, picture.filename().string());
  writeLightMap(picture, written.map);
  writeGlb(written.file, document);
  return written;
}

std::optional<Bake> readAgain(const WrittenLightMap& written) {
  Warnings warnings;
  return readBake(readGltf(written.file, warnings), written.compiled);
}

void expectSame(const WrittenLightMap& written, const LightMap& copy) {
  const LightMapLayout &layout = written.map.layout, &got = copy.layout;
  EXPECT_EQ(copy.values, written.map.values);
  EXPECT_EQ(copy.coefficients, written.map.coefficients);
  ASSERT_EQ(got.width, layout.width);
  ASSERT_EQ(got.height, layout.height);
  ASSERT_EQ(got.chartOf.size(), layout.chartOf.size());
  std::size_t wrong = 0;
  for (std::size_t f = 0; f < layout.chartOf.size(); ++f) {
    ASSERT_EQ(got.chartOf[f] == LightMapLayout::noChart, layout.chartOf[f] == LightMapLayout::noChart) << f;
    for (std::size_t c = 0; c < 3 && layout.chartOf[f] != LightMapLayout::noChart; ++c)
      wrong += glm::distance(got.corners[3 * f + c], layout.corners[3 * f + c]) > 1e-3f ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
  // Texels at the border of the texels that look-ups meet may differ by rounding.
  EXPECT_NEAR(double(got.texels.size()), double(layout.texels.size()), 0.002 * double(layout.texels.size()));
}

Json& lightMapEntryOf(GltfDocument& document, std::size_t node = 0) {
  return document.json["nodes"][node]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["lightmap"];
}

/// The triangle with a white, non-metallic material.
GltfDocument litTriangle() {
  GltfDocument document = test::triangleDocument();
  document.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}}});
  document.json["meshes"][0]["primitives"][0]["material"] = 0;
  return document;
}

TEST(BakedLightMap, WriteRead_GivesItBack) {
  for (const char* name : {"cornell", "rooms", "shapes"}) {
    const WrittenLightMap written = write(makeBuiltinScene(name));
    const std::optional<Bake> copy = readAgain(written);
    ASSERT_TRUE(copy && copy->lightMap) << name;
    expectSame(written, *copy->lightMap);
  }
}

TEST(BakedLightMap, RadianceForBumpMaps_ComesBack) {
  const WrittenLightMap written = write(makeBuiltinScene("cornell"), 5);
  const std::optional<Bake> copy = readAgain(written);
  ASSERT_TRUE(copy && copy->lightMap);
  expectSame(written, *copy->lightMap);
}

TEST(BakedLightMap, FlatQuads_NeedNoIndices) {
  const WrittenLightMap written = write(makeBuiltinScene("cornell"));
  Warnings warnings;
  GltfDocument document = readGltf(written.file, warnings);
  std::size_t maps = 0;
  for (std::size_t node = 0; node < document.json["nodes"].size(); ++node) {
    if (!document.json["nodes"][node].contains("mesh")) continue;
    for (const Json& primitive :
         document.json["nodes"][node]["extensions"]["PRELIGHT_transfer"]["primitives"]) {
      if (!primitive.contains("lightmap")) continue;
      ++maps;
      EXPECT_FALSE(primitive["lightmap"].contains("indices")) << node;
      EXPECT_EQ(primitive["lightmap"]["image"], "room%20with%20%231.lightmap.exr");
    }
  }
  EXPECT_GT(maps, 3u);
}

/// A mirrored node with a smooth ball, and a primitive whose triangles have no area.
TEST(BakedLightMap, MirroredNodes_KeepTheirCorners) {
  GltfDocument document = makeBuiltinScene("shapes");
  for (Json& node : document.json["nodes"])
    if (node.contains("mesh")) {
      node.erase("matrix");
      node["scale"] = {-1.0, 1.0, 1.0};
    }
  const WrittenLightMap written = write(std::move(document));
  const std::optional<Bake> copy = readAgain(written);
  ASSERT_TRUE(copy && copy->lightMap);
  expectSame(written, *copy->lightMap);
}

/// Balls in which every third triangle is wound against the normals, and a room that faces away from its
/// lamp.
TEST(BakedLightMap, TurnedTriangles_KeepTheirCorners) {
  CompiledScene ball = test::sphere(8, 0.5f, {0.0f, 1.0f, 0.0f});
  for (std::size_t t = 0; t < ball.triangles.size(); t += 3)
    std::swap(ball.triangles[t].y, ball.triangles[t].z);
  const LoadedScene scene = test::SceneMaker()
                                .add("ball", ball)
                                .add("room", test::box(4, {-2, 0, -2}, {2, 3, 2}, false))
                                .addLamp({1.0, 2.0, 1.0})
                                .addCamera({1.5, 1.0, 1.5})
                                .make();
  const WrittenLightMap written = write(*scene.document);
  ASSERT_FALSE(written.compiled.triangleTurns.empty());
  const std::optional<Bake> copy = readAgain(written);
  ASSERT_TRUE(copy && copy->lightMap);
  expectSame(written, *copy->lightMap);
}

TEST(BakedLightMap, BacksOfTwoSidedSurfaces_ComeBack) {
  GltfDocument document = litTriangle();
  document.json["materials"][0]["doubleSided"] = true;
  const WrittenLightMap written = write(std::move(document));
  ASSERT_EQ(written.map.layout.chartCount, 2u);
  const std::optional<Bake> copy = readAgain(written);
  ASSERT_TRUE(copy && copy->lightMap);
  expectSame(written, *copy->lightMap);
}

TEST(BakedLightMap, Picture_IsIrradiance) {
  const WrittenLightMap written = write(litTriangle());
  const Picture picture = readPicture(lightMapPath(written.file));
  ASSERT_EQ(picture.pixels.size(), written.map.layout.texelCount());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(picture.pixels[i][c], written.map.values[3 * i + static_cast<std::size_t>(c)]);
}

TEST(BakedLightMap, BakedAnew_LeavesNothingBehind) {
  const WrittenLightMap written = write(litTriangle());
  Warnings warnings;
  GltfDocument document = readGltf(written.file, warnings);
  embedBake(document, written.compiled, Bake{});
  GltfDocument plain = litTriangle();
  embedBake(plain, written.compiled, Bake{});
  EXPECT_EQ(document.json["accessors"].size(), plain.json["accessors"].size());
  EXPECT_FALSE(readBake(document, written.compiled)->lightMap);
}

/// Expects that a file changed by `spoil` is refused with a message that contains `word`.
void expectLightMapComplaint(const WrittenLightMap& written, const std::function<void(GltfDocument&)>& spoil,
                             const std::string& word) {
  Warnings warnings;
  GltfDocument document = readGltf(written.file, warnings);
  spoil(document);
  const std::string message = test::inputErrorOf([&] { readBake(document, written.compiled); });
  EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(BakedLightMap, MissingPicture_IsRefused) {
  const WrittenLightMap written = write(litTriangle());
  fs::remove(lightMapPath(written.file));
  expectLightMapComplaint(
      written, [](GltfDocument&) {}, "lightmap.exr: no such file");
}

TEST(BakedLightMap, TruncatedPicture_IsRefused) {
  const WrittenLightMap written = write(litTriangle());
  const fs::path picture = lightMapPath(written.file);
  for (const double share : {0.5, 0.9, 0.01}) {
    fs::resize_file(picture, static_cast<std::uintmax_t>(share * double(fs::file_size(picture))));
    expectLightMapComplaint(
        written, [](GltfDocument&) {}, "lightmap.exr");
  }
  std::ofstream(picture) << "not a picture";
  expectLightMapComplaint(
      written, [](GltfDocument&) {}, "lightmap.exr");
}

TEST(BakedLightMap, NumbersThatAreNone_AreRefused) {
  WrittenLightMap written = write(litTriangle());
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -1.0f}) {
    written.map.values[4] = bad;
    writeLightMap(lightMapPath(written.file), written.map);
    expectLightMapComplaint(
        written, [](GltfDocument&) {}, "channel G of texel 1, 0");
  }
}

TEST(BakedLightMap, WrongMembers_AreRefused) {
  const WrittenLightMap written = write(litTriangle());
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d)["texCoord"] = 0; }, "/lightmap/texCoord");
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d)["texCoord"] = 999; }, "/lightmap/texCoord");
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d).erase("image"); }, "image");
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d)["image"] = "data:,"; }, "/lightmap/image");
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d)["image"] = "none.exr"; }, "no such file");
  expectLightMapComplaint(
      written, [](GltfDocument& d) { lightMapEntryOf(d) = 3; }, "/lightmap");
  expectLightMapComplaint(
      written,
      [](GltfDocument& d) {
        lightMapEntryOf(d)["texCoord"] = test::appendFloats(d, {0.0f, 0.0f, 0.5f, 0.0f, 0.0f, 1.5f}, "VEC2");
      },
      "expected 0..1");
  expectLightMapComplaint(
      written,
      [](GltfDocument& d) {
        lightMapEntryOf(d)["texCoord"] = test::appendFloats(d, {0.0f, 0.0f}, "VEC2");
      },
      "expected 3 values, got 1");
  expectLightMapComplaint(
      written,
      [](GltfDocument& d) {
        const std::vector<std::uint32_t> indices = {0, 1, 7};
        lightMapEntryOf(d)["indices"] =
            appendAccessor(d, std::as_bytes(std::span(indices)), "SCALAR", 5125, 3);
      },
      "index 7 of 3");
  expectLightMapComplaint(
      written,
      [](GltfDocument& d) {
        const std::vector<std::uint32_t> indices = {0, 1};
        lightMapEntryOf(d)["indices"] =
            appendAccessor(d, std::as_bytes(std::span(indices)), "SCALAR", 5125, 2);
      },
      "expected 3 values, got 2");
}

}  // namespace
}  // namespace prelight
