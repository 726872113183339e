#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "library/open_scene.h"
#include "prelight/bake.h"
#include "prelight/refine.h"
#include "refine/shadowed_floor.h"
#include "scene/gltf/charts.h"
#include "scene/gltf/gltf_embed.h"
#include "support/devices.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

TEST(UnwrappedScene, PrimitivesWithoutCoordinates_GetCharts) {
  const LoadedScene scene = test::shadowedFloor();
  ASSERT_TRUE(makeCharts(scene.scene, scene.compiled, 64).charts.empty());
  const LoadedScene unwrapped = unwrap(scene, 64);
  const Charts charts = makeCharts(unwrapped.scene, unwrapped.compiled, 64);
  EXPECT_EQ(charts.charts.size(), 2u);
  EXPECT_TRUE(charts.leftOut.empty());
  EXPECT_EQ(charts.charts[0].texCoord, 1);
  EXPECT_EQ(charts.charts[0].width, 64);  // the floor is the largest
  EXPECT_EQ(unwrapped.compiled.triangleCount(), scene.compiled.triangleCount());
}

TEST(UnwrappedScene, CoordinatesThatServe_Stay) {
  const LoadedScene once = unwrap(test::shadowedFloor(), 64);
  const LoadedScene twice = unwrap(once, 64);
  EXPECT_EQ(once.document, twice.document);
}

/// Reads the document of the floor and the box after a change.
LoadedScene changedFloor(const std::function<void(GltfDocument&)>& change) {
  GltfDocument document = *test::shadowedFloor().document;
  change(document);
  return loadDocument([&](Warnings&) { return std::move(document); }, {});
}

/// Property tables of metadata name their buffer views in their own way.
TEST(UnwrappedScene, Metadata_KeepsItsBytes) {
  const std::vector<std::uint8_t> names = {'a', 'b', 'c'}, offsets = {0, 0, 0, 0, 3, 0, 0, 0};
  const LoadedScene unwrapped = unwrap(
      changedFloor([&](GltfDocument& document) {
        const int values = appendBufferView(document, names);
        const int ends = appendBufferView(document, offsets);
        Json table = {{"class", "thing"}, {"count", 1}};
        table["properties"]["name"] = {{"values", values}, {"stringOffsets", ends}};
        document.json["extensionsUsed"].push_back("EXT_structural_metadata");
        document.json["extensions"]["EXT_structural_metadata"] = {{"propertyTables", Json::array({table})}};
      }),
      64);
  const GltfDocument& document = *unwrapped.document;
  const auto bytesOf = [&](const char* member) {
    const Json& view =
        document.json["bufferViews"]
                     [document
                          .json[Json::json_pointer(
                              "/extensions/EXT_structural_metadata/propertyTables/0/properties/name")][member]
                          .get<std::size_t>()];
    const auto begin = document.bin.begin() + view["byteOffset"].get<std::ptrdiff_t>();
    return std::vector<std::uint8_t>(begin, begin + view["byteLength"].get<std::ptrdiff_t>());
  };
  EXPECT_EQ(bytesOf("values"), names);
  EXPECT_EQ(bytesOf("stringOffsets"), offsets);
}

TEST(UnwrappedScene, UnknownExtension_KeepsAllBytes) {
  const std::vector<std::uint8_t> bytes = {1, 2, 3, 4};
  int view = 0;
  const LoadedScene unwrapped = unwrap(changedFloor([&](GltfDocument& document) {
                                         view = appendBufferView(document, bytes);
                                         document.json["extensionsUsed"].push_back("ACME_invented");
                                         document.json["extensions"]["ACME_invented"]["bytes"] = view;
                                       }),
                                       64);
  const Json& json = unwrapped.document->json;
  ASSERT_EQ(json["extensions"]["ACME_invented"]["bytes"], view);
  const auto begin = json["bufferViews"][static_cast<std::size_t>(view)]["byteOffset"].get<std::size_t>();
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(),
                         unwrapped.document->bin.begin() + static_cast<std::ptrdiff_t>(begin)));
}

TEST(UnwrappedScene, FeaturesInTheSecondSet_Stay) {
  const LoadedScene unwrapped = unwrap(changedFloor([](GltfDocument& document) {
                                         document.json["extensionsUsed"].push_back("EXT_mesh_features");
                                         for (Json& mesh : document.json["meshes"])
                                           if (mesh["name"] == "Floor")
                                             mesh["primitives"][0]["extensions"]["EXT_mesh_features"] = {
                                                 {"featureIds", {{{"texture", {{"texCoord", 1}}}}}}};
                                       }),
                                       64);
  for (const Json& mesh : unwrapped.document->json["meshes"])
    EXPECT_EQ(mesh["primitives"][0]["attributes"].contains("TEXCOORD_1"), mesh["name"] != "Floor");
}

TEST(UnwrappedScene, SizeOutOfRange_IsRefused) {
  for (const int size : {-5, 0, BakeRequest::maxChartSize + 1})
    EXPECT_THROW(unwrap(test::shadowedFloor(), size), UsageError) << size;
}

/// The floor's texels below the box are dark, although its vertices are not.
TEST(UnwrappedScene, TransferAtTexels_HasShadows) {
  const LoadedScene scene = unwrap(test::shadowedFloor(), 64);
  const BakeResult baked =
      bake(scene, {.sh = {.order = 2}, .chartTransfer = {.size = 64}, .effort = {.rays = 256}},
           {.device = &test::sharedDevice()});
  ASSERT_TRUE(baked.bake.chartTransfer);
  const ChartTransfer& texels = *baked.bake.chartTransfer;
  const auto row = [&](std::size_t texel) { return texels.maps[0].coefficients[texel * texels.rowLength()]; };
  float least = 1.0f, most = 0.0f;
  for (std::size_t texel = 0; texel < texels.maps[0].texels(); ++texel) {
    least = std::min(least, row(texel));
    most = std::max(most, row(texel));
  }
  const float open = 0.5f * std::sqrt(1.0f / 3.14159265f);  // of band 0
  EXPECT_NEAR(most, open, 0.02f * open);
  EXPECT_LT(least, 0.15f * open);
}

}  // namespace
}  // namespace prelight
