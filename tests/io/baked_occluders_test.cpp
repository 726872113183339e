#include <gtest/gtest.h>

#include <functional>

#include "io/baked_file.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Two nodes of a triangle each.
GltfDocument twoTriangles() {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  return document;
}

/// 0, 1, 2, 0, 1, 2 records a vertex.
Bake someOccluders() {
  OccluderTransfer transfer{{"a", "b"}, {OccluderVector::Position, OccluderVector::Occlusion}, {0}, {}, {}};
  for (std::uint32_t v = 0; v < 6; ++v) {
    for (std::uint32_t r = 0; r < v % 3; ++r) {
      transfer.occluders.push_back(r);
      transfer.vectors.emplace_back(v, r, 1, 2);
      transfer.vectors.emplace_back(0, 0.5f, 0, 0.25f * static_cast<float>(v));
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
  }
  Bake bake;
  bake.occluders = transfer;
  return bake;
}

TEST(BakedOccluders, WriteRead_GivesThemBack) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = someOccluders();
  embedBake(document, scene, bake);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->occluders);
  EXPECT_EQ(copy->occluders->names, bake.occluders->names);
  EXPECT_EQ(copy->occluders->stored, bake.occluders->stored);
  EXPECT_EQ(copy->occluders->offsets, bake.occluders->offsets);
  EXPECT_EQ(copy->occluders->occluders, bake.occluders->occluders);
  EXPECT_EQ(copy->occluders->vectors, bake.occluders->vectors);
}

TEST(BakedOccluders, NoRecords_AreReadBackEmpty) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.occluders =
      OccluderTransfer{{}, {OccluderVector::Occlusion}, std::vector<std::uint32_t>(7, 0), {}, {}};
  embedBake(document, scene, bake);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->occluders);
  EXPECT_EQ(copy->occluders->offsets, bake.occluders->offsets);
  EXPECT_EQ(copy->occluders->recordCount(), 0u);
}

void expectRefused(const std::function<void(Json& vo, Json& root)>& spoil, const std::string& part) {
  GltfDocument document = twoTriangles();
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, someOccluders());
  spoil(document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["vo"],
        document.json["extensions"]["PRELIGHT_transfer"]);
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(BakedOccluders, WhatDoesNotFit_IsRefusedByItsPath) {
  expectRefused([](Json& vo, Json&) { vo["stored"] = {"position"}; }, "vo");
  expectRefused([](Json& vo, Json&) { vo["stored"] = {"occlusion", "position"}; }, "stored");
  expectRefused([](Json& vo, Json&) { vo["stored"] = {"position", "shadow"}; }, "shadow");
  expectRefused([](Json& vo, Json&) { vo["stored"] = Json::array(); }, "stored");
  expectRefused([](Json& vo, Json&) { vo["offsets"] = vo["occluders"]; }, "offsets");
  expectRefused([](Json& vo, Json&) { vo["vectors"] = vo["occluders"]; }, "vectors");
  expectRefused([](Json&, Json& root) { root["vo"]["occluders"].erase(1); }, "occluder 1 of 1");
  expectRefused([](Json&, Json& root) { root.erase("vo"); }, "name the occluders");
}

}  // namespace
}  // namespace prelight
