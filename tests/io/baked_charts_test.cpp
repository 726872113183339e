#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "io/baked_file.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

CompiledScene compiled(const GltfDocument& document) {
  Warnings warnings;
  return compileScene(loadScene(document, warnings), warnings);
}

ChartTransfer::Map someMap(const CompiledScene& scene, std::size_t primitive, int width, int height) {
  ChartTransfer::Map map{primitive, width, height, {}, {}};
  for (std::uint32_t v = 0; v < scene.primitives[primitive].vertexCount; ++v)
    map.coords.emplace_back(1.0f / static_cast<float>(v + 1), 0.25f);
  for (int i = 0; i < width * height * 12; ++i)
    map.coefficients.push_back(static_cast<float>(i) - 100.0f * static_cast<float>(primitive));
  return map;
}

/// Two nodes; the second has no light map.
GltfDocument twoTriangles() {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  return document;
}

Bake withMapOfFirst(const CompiledScene& scene) {
  Bake bake;
  bake.ao.assign(scene.vertexCount(), 0.5f);
  bake.bentNormals.assign(scene.vertexCount(), {0, 1, 0});
  bake.chartTransfer = ChartTransfer{2, 3, 1, {someMap(scene, 0, 3, 2)}};
  return bake;
}

TEST(BakedCharts, WriteRead_GivesThemBack) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = compiled(document);
  const Bake bake = withMapOfFirst(scene);
  embedBake(document, scene, bake);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->chartTransfer);
  EXPECT_EQ(copy->chartTransfer->order, 2);
  EXPECT_EQ(copy->chartTransfer->channels, 3);
  EXPECT_EQ(copy->chartTransfer->bounces, 1);
  ASSERT_EQ(copy->chartTransfer->maps.size(), 1u);
  const ChartTransfer::Map &got = copy->chartTransfer->maps[0], &expected = bake.chartTransfer->maps[0];
  EXPECT_EQ(got.primitive, expected.primitive);
  EXPECT_EQ(got.width, 3);
  EXPECT_EQ(got.height, 2);
  EXPECT_EQ(got.coords, expected.coords);
  EXPECT_EQ(got.coefficients, expected.coefficients);
}

TEST(BakedCharts, Instances_HaveMapsOfTheirOwn) {
  GltfDocument document = test::triangleDocument();
  const int moves = test::appendFloats(document, {0, 0, 0, 5, 0, 0, 0, 5, 0}, "VEC3");
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = moves;
  document.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const CompiledScene scene = compiled(document);
  ASSERT_EQ(scene.primitives.size(), 3u);
  Bake bake;
  bake.chartTransfer =
      ChartTransfer{2, 3, 1, {someMap(scene, 0, 2, 2), someMap(scene, 1, 2, 2), someMap(scene, 2, 2, 2)}};
  embedBake(document, scene, bake);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->chartTransfer);
  ASSERT_EQ(copy->chartTransfer->maps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(copy->chartTransfer->maps[i].primitive, i);
    EXPECT_EQ(copy->chartTransfer->maps[i].coefficients, bake.chartTransfer->maps[i].coefficients);
  }
}

TEST(BakedCharts, BakedAgain_LeavesNothingBehind) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = compiled(document);
  const std::size_t size = document.bin.size(), accessors = document.json["accessors"].size();
  embedBake(document, scene, withMapOfFirst(scene));
  Bake bake;
  bake.ao.assign(scene.vertexCount(), 0.5f);
  bake.bentNormals.assign(scene.vertexCount(), {0, 1, 0});
  embedBake(document, scene, bake);
  EXPECT_LE(document.bin.size(), size + 6 * 16 + 16);
  EXPECT_EQ(document.json["accessors"].size(), accessors + 4);
}

void expectRefused(const std::function<void(Json&)>& spoil, const std::string& part) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = compiled(document);
  embedBake(document, scene, withMapOfFirst(scene));
  spoil(document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["texels"]);
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(BakedCharts, WhatDoesNotFit_IsRefusedByItsPath) {
  expectRefused([](Json& texels) { texels["width"] = 4; }, "texels/coefficients");
  expectRefused([](Json& texels) { texels["height"] = 0; }, "texels/height");
  expectRefused([](Json& texels) { texels["width"] = 1u << 20; }, "texels/width");
  expectRefused([](Json& texels) { texels["order"] = 33; }, "texels/order");
  expectRefused([](Json& texels) { texels["channels"] = 2; }, "texels/channels");
  expectRefused([](Json& texels) { texels["texCoord"] = texels["coefficients"]; }, "texels/texCoord");
  expectRefused([](Json& texels) { texels["coefficients"] = 999; }, "texels/coefficients");
  expectRefused([](Json& texels) { texels = 3; }, "texels");
}

TEST(BakedCharts, ValuesThatAreNotFinite_AreRefused) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = compiled(document);
  Bake bake = withMapOfFirst(scene);
  bake.chartTransfer->maps[0].coefficients[7] = 0.7654321f;
  embedBake(document, scene, bake);
  test::replaceFloats(document, 0.7654321f, std::numeric_limits<float>::quiet_NaN());
  EXPECT_NE(test::inputErrorOf([&] { readBake(document, scene); }).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace prelight
