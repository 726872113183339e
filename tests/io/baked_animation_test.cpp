#include <gtest/gtest.h>

#include "io/baked_file.h"
#include "io/misfit.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// A moving triangle on two nodes, one of which also has a primitive of points.
GltfDocument movingDocument() {
  GltfDocument document = test::triangleDocument();
  auto& json = document.json;
  auto& primitives = json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["mode"] = 0;
  json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
  json["scenes"][0]["nodes"] = {1, 0};
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int places = test::appendFloats(document, {0, 0, 0, 2, 0, 0}, "VEC3");
  json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  return document;
}

HarmonicTransfer transferOf(const CompiledScene& scene, float offset) {
  HarmonicTransfer transfer{2, 3, 1, {}};
  for (std::uint32_t v = 0; v < 12 * scene.vertexCount(); ++v)
    transfer.coefficients.push_back(offset + 0.01f * static_cast<float>(v));
  return transfer;
}

Bake makeBake(const CompiledScene& scene) {
  Bake bake;
  bake.sh = transferOf(scene, 0.0f);
  bake.animation = {0, {0.0, 0.25, 1.0}, {}};
  for (const float offset : {10.0f, 20.0f, 30.0f}) bake.animation->keys.push_back(transferOf(scene, offset));
  bake.info.device = "no device";
  return bake;
}

TEST(BakedAnimation, EmbedWriteRead_GivesTheKeysBack) {
  const test::TemporaryFolder folder;
  GltfDocument document = movingDocument();
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = makeBake(scene);
  embedBake(document, scene, bake);
  writeGlb(folder / "baked.glb", document);
  Warnings warnings;
  const GltfDocument copy = readGltf(folder / "baked.glb", warnings);
  const std::optional<Bake> read = readBake(copy, test::compileDocument(copy));
  ASSERT_TRUE(read && read->animation);
  EXPECT_EQ(read->sh->coefficients, bake.sh->coefficients);
  EXPECT_EQ(read->animation->animation, 0u);
  EXPECT_EQ(read->animation->times, bake.animation->times);
  ASSERT_EQ(read->animation->keys.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read->animation->keys[k].coefficients, bake.animation->keys[k].coefficients);
    EXPECT_EQ(read->animation->keys[k].order, 2);
    EXPECT_EQ(read->animation->keys[k].bounces, 1);
  }
  EXPECT_EQ(copy.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][1], Json::object());
}

TEST(BakedAnimation, BakingAgain_TakesTheKeysAway) {
  GltfDocument document = movingDocument();
  const CompiledScene scene = test::compileDocument(document);
  const Json original = document.json;
  const std::size_t bytes = document.bin.size();
  embedBake(document, scene, makeBake(scene));
  embedBake(document, scene, Bake{});
  EXPECT_EQ(document.json["accessors"], original["accessors"]);
  EXPECT_EQ(document.json["animations"], original["animations"]);
  EXPECT_EQ(document.bin.size(), (bytes + 3) / 4 * 4);
}

using test::Misfit;

class MisfitKeys : public testing::TestWithParam<Misfit> {};

TEST_P(MisfitKeys, Read_ThrowsNamingThePlace) {
  const GltfDocument document = movingDocument();
  const CompiledScene scene = test::compileDocument(document);
  test::expectRefused(document, makeBake(scene), scene, GetParam());
}

#define KEYS "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/keys"
#define ANIMATION "/extensions/PRELIGHT_transfer/animation"
const Misfit misfits[] = {
    {"Count", KEYS, "[]", "keys: 0 keys, but the root gives 3 times"},
    {"NoSh", KEYS "/1", "{}", "keys/1"},
    {"Order", KEYS "/1/sh/order", "3", "keys/1/sh/coefficients: expected 81"},
    {"Channels", KEYS "/2/sh/channels", "2", "keys/2/sh/channels: expected 1 or 3"},
    {"Bounces", KEYS "/2/sh/bounces", "7", "keys/2/sh: expected the order, channels and bounces"},
    {"Index", KEYS "/0/sh/coefficients", "999", "coefficients: accessor index 999"},
    {"Animation", ANIMATION "/index", "1", "animation/index"},
    {"NoTimes", ANIMATION "/times", "[]", "animation/times: expected 1..1024 times, got 0"},
    {"Descending", ANIMATION "/times/2", "0.125", "animation/times/2: expected seconds >= 0 that ascend"},
    {"Negative", ANIMATION "/times/0", "-1", "animation/times/0: expected seconds >= 0 that ascend"},
    {"TimeType", ANIMATION "/times/1", "\"1\"", "animation/times/1"},
    {"NoRoot", "/extensions/PRELIGHT_transfer", "{}", "does not give the times"},
};
#undef KEYS
#undef ANIMATION

INSTANTIATE_TEST_SUITE_P(Table, MisfitKeys, testing::ValuesIn(misfits),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(BakedAnimation, KeysOnOnePrimitiveOnly_AreRefused) {
  GltfDocument document = movingDocument();
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, makeBake(scene));
  document.json["nodes"][1]["extensions"]["PRELIGHT_transfer"]["primitives"][0].erase("keys");
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find("same techniques"), std::string::npos) << message;
}

}  // namespace
}  // namespace prelight
