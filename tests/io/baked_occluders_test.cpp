#include <gtest/gtest.h>

#include <functional>

#include "io/baked_file.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Two nodes with a triangle each.
GltfDocument shadedTriangles() {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  return document;
}

/// A bake with 0, 1, 2, 0, 1, 2 records per vertex.
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
  GltfDocument document = shadedTriangles();
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
  GltfDocument document = shadedTriangles();
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

/// Embeds quantized records, one for every second vertex of `scene`, into the document.
OccluderTransfer embedQuantized(GltfDocument& document, const CompiledScene& scene) {
  Bake bake = someOccluders();
  OccluderTransfer& transfer = *bake.occluders;
  for (std::size_t i = 0; i < transfer.vectors.size(); i += 2) {
    transfer.vectors[i] = glm::vec4(1, 2, 3, 5);
    transfer.vectors[i + 1] = glm::vec4(0, 0.1f, 0, 0.125f);
  }
  std::vector<glm::dvec3> vertices;
  for (const glm::vec3& position : scene.positions) vertices.push_back(scene.origin + glm::dvec3(position));
  const QuantizedOccluders quantized = quantizeOccluders(transfer, vertices);
  const StoredForms forms{.occluders = quantized};
  embedBake(document, scene, bake, &forms);
  return dequantizeOccluders(quantized, vertices);
}

TEST(BakedOccluders, Quantized_AreReadAsTheyWereDecoded) {
  GltfDocument document = shadedTriangles();
  const CompiledScene scene = test::compileDocument(document);
  const OccluderTransfer decoded = embedQuantized(document, scene);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->occluders);
  EXPECT_EQ(copy->occluders->names, decoded.names);
  EXPECT_EQ(copy->occluders->stored, decoded.stored);
  EXPECT_EQ(copy->occluders->offsets, decoded.offsets);
  EXPECT_EQ(copy->occluders->occluders, decoded.occluders);
  EXPECT_EQ(copy->occluders->vectors, decoded.vectors);
  embedBake(document, scene, *copy);  // Embedded again without quantization: no quantized bytes remain.
  EXPECT_EQ(document.json.dump().find("\"bytes\""), std::string::npos);
}

TEST(BakedOccluders, QuantizedThatDoNotFit_AreRefused) {
  const auto refused = [](const std::function<void(Json & vo, Json & root)>& spoil) {
    GltfDocument document = shadedTriangles();
    const CompiledScene scene = test::compileDocument(document);
    embedQuantized(document, scene);
    spoil(document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["vo"],
          document.json["extensions"]["PRELIGHT_transfer"]["vo"]);
    return test::inputErrorOf([&] { readBake(document, scene); });
  };
  EXPECT_EQ(refused([](Json&, Json&) {}), "");
  EXPECT_NE(refused([](Json&, Json& root) { root.erase("distances"); }).find("distances"), std::string::npos);
  EXPECT_NE(refused([](Json&, Json& root) {
              root["distances"] = {0, 1};
            }).find("distances"),
            std::string::npos);
  EXPECT_NE(refused([](Json&, Json& root) {
              root["distances"] = {2, 1};
            }).find("distances"),
            std::string::npos);
  EXPECT_NE(refused([](Json&, Json& root) { root["distances"] = {1}; }).find("distances"), std::string::npos);
  EXPECT_NE(refused([](Json& vo, Json&) { vo["stored"] = {"position"}; }), "");
  EXPECT_NE(refused([](Json& vo, Json&) { vo["bytes"] = vo["offsets"]; }).find("bytes"), std::string::npos);
}

void expectRefused(const std::function<void(Json& vo, Json& root)>& spoil, const std::string& part) {
  GltfDocument document = shadedTriangles();
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
