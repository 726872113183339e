#include "io/baked_file.h"
#include "io/misfit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

Bake wholeBake(const CompiledScene& scene) {
  Bake bake;
  bake.sh = HarmonicTransfer{2, 3, 1, {}};
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    bake.ao.push_back(static_cast<float>(v) / static_cast<float>(scene.vertexCount()));
    bake.bentNormals.push_back(scene.normals[v]);
    for (int i = 0; i < 12; ++i)
      bake.sh->coefficients.push_back(static_cast<float>(v) + 0.01f * static_cast<float>(i));
  }
  Plan plan;
  plan.passes = {{Pass::Cast, true, "any hit is enough"}, {Pass::Bounces, false, "none are asked for"}};
  plan.hostBytes = 12;
  bake.info = {"Prelight test", 7, 1000, 0.25, 1, plan, "no device", 1.5};
  return bake;
}

/// Two nodes that share a mesh of two primitives, the second of points.
GltfDocument sharedMeshDocument() {
  GltfDocument document = test::triangleDocument();
  auto& json = document.json;
  auto& primitives = json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["mode"] = 0;
  json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
  json["scenes"][0]["nodes"] = {1, 0};
  return document;
}

TEST(BakedFile, EmbedWriteRead_GivesTheBakeBack) {
  const test::TemporaryFolder folder;
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = wholeBake(scene);
  embedBake(document, scene, bake);
  writeGlb(folder / "baked.glb", document);
  Warnings warnings;
  const std::optional<Bake> copy = readBake(readGltf(folder / "baked.glb", warnings), scene);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->ao, bake.ao);
  EXPECT_EQ(copy->bentNormals, bake.bentNormals);
  ASSERT_TRUE(copy->sh);
  EXPECT_EQ(copy->sh->order, 2);
  EXPECT_EQ(copy->sh->channels, 3);
  EXPECT_EQ(copy->sh->bounces, 1);
  EXPECT_EQ(copy->sh->coefficients, bake.sh->coefficients);
  EXPECT_EQ(copy->info.seed, 7u);
  EXPECT_EQ(copy->info.rays, 1000u);
  EXPECT_EQ(copy->info.plan, bake.info.plan);
  EXPECT_EQ(copy->info.device, "no device");
  EXPECT_TRUE(warnings.empty()) << "a baked file needs no complaint: " << warnings.front();
}

TEST(BakedFile, WhatDrewTheViews_ComesBack_AndIsLeftOutOfBakesByRays) {
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = wholeBake(scene);
  embedBake(document, scene, bake);
  EXPECT_FALSE(document.json["extensions"]["PRELIGHT_transfer"].contains("visibility"));
  bake.info.visibility = "OpenGL";
  embedBake(document, scene, bake);
  EXPECT_EQ(readBake(document, scene)->info.visibility, "OpenGL");
}

TEST(BakedFile, LimitsAndShadowSets_ComeBack_AndAreLeftOutWithoutAny) {
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = wholeBake(scene);
  embedBake(document, scene, bake);
  const Json& root = document.json["extensions"]["PRELIGHT_transfer"];
  EXPECT_FALSE(root.contains("limits") || root.contains("shadowSets"));
  bake.info.limits = {0.01, 3.0, 2.0};
  bake.info.shadowSets = {{{"ball*", "box"}, {}}, {{"floor"}, {"box"}}};
  embedBake(document, scene, bake);
  const std::optional<Bake> read = readBake(document, scene);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->info.limits.nearest, 0.01);
  EXPECT_EQ(read->info.limits.farthest, 3.0);
  EXPECT_EQ(read->info.limits.obscurance, 2.0);
  ASSERT_EQ(read->info.shadowSets.size(), 2u);
  EXPECT_EQ(read->info.shadowSets[0].receivers, bake.info.shadowSets[0].receivers);
  EXPECT_TRUE(read->info.shadowSets[0].occluders.empty());
  EXPECT_EQ(read->info.shadowSets[1].occluders, bake.info.shadowSets[1].occluders);
  document.json["extensions"]["PRELIGHT_transfer"]["limits"]["far"] = -1.0;
  EXPECT_THROW(readBake(document, scene), InputError);
}

/// A file of a later version may name passes that this version does not know. Users see them all the same.
TEST(BakedFile, PassesOfUnknownNames_AreKept) {
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, wholeBake(scene));
  Json& plan = document.json["extensions"]["PRELIGHT_transfer"]["plan"];
  plan["passes"].push_back({{"name", "teleportation"}, {"runs", true}, {"reason", "why not"}});
  const std::optional<Bake> read = readBake(document, scene);
  ASSERT_TRUE(read);
  Plan expected = wholeBake(scene).info.plan;
  expected.passes.push_back({"teleportation", true, "why not"});
  EXPECT_EQ(read->info.plan, expected);
  plan["passes"] = 3;
  EXPECT_THROW((void)readBake(document, scene), InputError);
}

/// Numbers that the reader would refuse are not written.
TEST(BakedFile, NumbersThatAreNotUsable_AreNotWritten) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), -1e30f}) {
    GltfDocument document = sharedMeshDocument();
    const CompiledScene scene = test::compileDocument(document);
    Bake bake;
    bake.ao.assign(scene.vertexCount(), 0.5f);
    bake.ao.back() = bad;
    try {
      embedBake(document, scene, bake);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
      EXPECT_NE(std::string(error.what()).find("/primitives/0/ao"), std::string::npos) << error.what();
    }
  }
}

TEST(BakedFile, CoefficientsBeyondMeasure_AreRefused) {
  GltfDocument document = sharedMeshDocument();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.ao.assign(scene.vertexCount(), 0.5f);
  embedBake(document, scene, bake);
  document.json["nodes"][1]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["ao"] =
      test::appendFloats(document, {0.5f, 1e38f, 0.5f}, "SCALAR");
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find("at most 1e+18"), std::string::npos) << message;
}

TEST(BakedFile, Irradiance_ComesBackAndIsChecked) {
  GltfDocument document = sharedMeshDocument();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.irradiance.emplace();
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const auto x = static_cast<float>(v);
    bake.irradiance->emplace_back(x, 2.5f * x, 0.125f);
  }
  embedBake(document, scene, bake);
  EXPECT_EQ(*readBake(document, scene)->irradiance, *bake.irradiance);
  bake.irradiance->at(4).y = -1.0f;
  embedBake(document, scene, bake);
  EXPECT_NE(test::inputErrorOf([&] { readBake(document, scene); }).find("below 0"), std::string::npos);
}

TEST(BakedFile, Extension_IsUsedButNotRequired) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, wholeBake(scene));
  EXPECT_EQ(document.json["extensionsUsed"], Json::array({"PRELIGHT_transfer"}));
  EXPECT_FALSE(document.json.contains("extensionsRequired"));
  EXPECT_EQ(document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"].size(), 1u);
  EXPECT_EQ(document.json["extensions"]["PRELIGHT_transfer"]["generator"], "Prelight test");
}

TEST(BakedFile, SharedMesh_HasValuesOnEachNodeAndNoneForPoints) {
  GltfDocument document = sharedMeshDocument();
  const CompiledScene scene = test::compileDocument(document);
  ASSERT_EQ(scene.vertexCount(), 6u);
  const Bake bake = wholeBake(scene);
  embedBake(document, scene, bake);
  for (int node = 0; node < 2; ++node) {
    const Json& primitives =
        document
            .json["nodes"][static_cast<std::size_t>(node)]["extensions"]["PRELIGHT_transfer"]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    EXPECT_TRUE(primitives[0].contains("ao"));
    EXPECT_EQ(primitives[1], Json::object());
  }
  EXPECT_EQ(readBake(document, scene)->ao, bake.ao);
}

TEST(BakedFile, Instances_AreStoredOneAfterTheOther) {
  GltfDocument document = test::triangleDocument();
  const int offsets = test::appendFloats(document, {0, 0, 0, 0, 0, 4}, "VEC3");
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = offsets;
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = wholeBake(scene);
  embedBake(document, scene, bake);
  const auto& primitive = document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0];
  EXPECT_EQ(document.json["accessors"][primitive["ao"].get<std::size_t>()]["count"], 6);
  EXPECT_EQ(readBake(document, scene)->ao, bake.ao);
  embedBake(document, scene, Bake{});
  EXPECT_TRUE(document.json["nodes"][0]["extensions"].contains("EXT_mesh_gpu_instancing"));
}

TEST(BakedFile, BakingAgain_DoesNotGrowTheFile) {
  for (GltfDocument document : {makeBuiltinScene("shapes"), sharedMeshDocument()}) {
    const CompiledScene scene = test::compileDocument(document);
    const Json original = document.json;
    const auto originalBin = document.bin;
    const Bake bake = wholeBake(scene);
    embedBake(document, scene, bake);
    const GltfDocument once = document;
    embedBake(document, scene, bake);
    EXPECT_TRUE(document.json == once.json);
    EXPECT_TRUE(document.bin == once.bin);
    embedBake(document, scene, Bake{});
    EXPECT_TRUE(document.json["accessors"] == original["accessors"]);
    EXPECT_TRUE(document.json["bufferViews"] == original["bufferViews"]);
    EXPECT_EQ(document.bin.size(), (originalBin.size() + 3) / 4 * 4) << "nothing but the padding may stay";
  }
}

TEST(BakedFile, BakingAgain_KeepsWhatSomethingElseRefersTo) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, wholeBake(scene));
  const std::size_t last = document.json["accessors"].size() - 1;
  document.json["meshes"][0]["primitives"][0]["attributes"]["_BORROWED"] = last;
  embedBake(document, scene, wholeBake(scene));
  EXPECT_EQ(document.json["meshes"][0]["primitives"][0]["attributes"]["_BORROWED"], last);
  EXPECT_EQ(document.json["accessors"][last]["count"], 36);
}

TEST(BakedFile, NoExtension_IsNoBake) {
  const GltfDocument document = test::triangleDocument();
  EXPECT_FALSE(readBake(document, test::compileDocument(document)));
}

using test::Misfit;

class MisfitBake : public testing::TestWithParam<Misfit> {};

TEST_P(MisfitBake, Read_ThrowsNamingThePlace) {
  const GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  test::expectRefused(document, wholeBake(scene), scene, GetParam());
}

const Misfit bakeMisfits[] = {
    {"Count", "/accessors/3/count", "2", "primitives/0/ao: expected 3 values, got 2"},
    {"Type", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/ao", "4",
     "ao: expected an accessor of type SCALAR"},
    {"Index", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/ao", "99", "ao: accessor index 99"},
    {"Order", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/sh/order", "3",
     "sh/coefficients: expected 81"},
    {"OrderZero", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/sh/order", "0",
     "sh/order: expected 1.."},
    {"Channels", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/sh/channels", "2",
     "sh/channels: expected 1 or 3"},
    {"Primitives", "/nodes/0/extensions/PRELIGHT_transfer/primitives", "[]", "primitives: 0 primitives"},
    {"NotObject", "/nodes/0/extensions/PRELIGHT_transfer/primitives/0", "[]",
     "primitives/0: expected an object"},
    {"NoNode", "/nodes/0/extensions", "{}", "/nodes/0: no PRELIGHT_transfer"},
    {"RootType", "/extensions/PRELIGHT_transfer/rays", "-1", "PRELIGHT_transfer/rays"},
};

INSTANTIATE_TEST_SUITE_P(Table, MisfitBake, testing::ValuesIn(bakeMisfits),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(BakedFile, NanValue_IsRefused) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = wholeBake(scene);
  bake.ao[1] = 0.7654321f;
  embedBake(document, scene, bake);
  test::replaceFloats(document, 0.7654321f, std::numeric_limits<float>::quiet_NaN());
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find("ao: value 1 is nan"), std::string::npos) << message;
}

VolumeTransfer makeVolume() {
  VolumeTransfer volume{{{3, 2, 1}, {-1, 0, 5}, {0.5, 1, 5.5}}, 2, 3, 1, {}, {}, {1, 1, 0, 1, 1, 1}};
  for (int i = 0; i < 6 * 12; ++i) volume.coefficients.push_back(0.5f * static_cast<float>(i));
  for (int i = 0; i < 6 * 4; ++i) volume.direct.push_back(-0.25f * static_cast<float>(i));
  volume.sentOrder = 2;
  for (int i = 0; i < 6 * 3 * 4 * 4; ++i) volume.sent.push_back(0.125f * static_cast<float>(i));
  volume.lightOrder = 3;
  for (int i = 0; i < 6 * 3 * 9 * 2; ++i) volume.lights.push_back(1.0f + 0.5f * static_cast<float>(i));
  return volume;
}

TEST(BakedFile, Volume_IsReadBackAndReplaced) {
  const test::TemporaryFolder folder;
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = wholeBake(scene);
  bake.volume = makeVolume();
  embedBake(document, scene, bake);
  const std::size_t bytes = document.bin.size();
  writeGlb(folder / "baked.glb", document);
  Warnings warnings;
  const std::optional<Bake> copy = readBake(readGltf(folder / "baked.glb", warnings), scene);
  ASSERT_TRUE(copy && copy->volume);
  EXPECT_EQ(copy->volume->grid.size, bake.volume->grid.size);
  EXPECT_EQ(copy->volume->grid.min, bake.volume->grid.min);
  EXPECT_EQ(copy->volume->grid.max, bake.volume->grid.max);
  EXPECT_EQ(copy->volume->order, 2);
  EXPECT_EQ(copy->volume->channels, 3);
  EXPECT_EQ(copy->volume->coefficients, bake.volume->coefficients);
  EXPECT_EQ(copy->volume->direct, bake.volume->direct);
  EXPECT_EQ(copy->volume->air, bake.volume->air);
  EXPECT_EQ(copy->volume->sentOrder, 2);
  EXPECT_EQ(copy->volume->sent, bake.volume->sent);
  EXPECT_EQ(copy->volume->lightOrder, 3);
  EXPECT_EQ(copy->volume->lights, bake.volume->lights);
  EXPECT_EQ(copy->volume->groups(), 2u);
  embedBake(document, scene, bake);
  EXPECT_EQ(document.bin.size(), bytes) << "the old volume is gone";
}

TEST(BakedFile, VolumeOfTheFirstBandAlone_IsReadBack) {
  GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = wholeBake(scene);
  bake.volume = VolumeTransfer{{{1, 1, 2}, {0, 0, 0}, {1, 1, 2}}, 1, 1, 0, {0.25f, -4.0f}, {}, {1, 0}};
  embedBake(document, scene, bake);
  const std::optional<Bake> copy = readBake(document, scene);
  ASSERT_TRUE(copy && copy->volume);
  EXPECT_EQ(copy->volume->order, 1);
  EXPECT_EQ(copy->volume->coefficients, bake.volume->coefficients);
}

TEST(BakedFile, VolumeThatDoesNotFitItself_IsRefused) {
  const GltfDocument plain = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(plain);
  const auto refuses = [&](const char* member, const Json& value) {
    GltfDocument document = plain;
    Bake bake = wholeBake(scene);
    bake.volume = makeVolume();
    embedBake(document, scene, bake);
    document.json["extensions"]["PRELIGHT_transfer"]["volume"][member] = value;
    EXPECT_THROW(readBake(document, scene), InputError) << member << ' ' << value;
  };
  refuses("size", {3, 2, 2});
  refuses("size", {0, 2, 1});
  refuses("size", {3, 2});
  refuses("max", {0.5, 1, 9});
  refuses("max", {-2, 1, 5.5});
  refuses("order", 33);
  refuses("order", 3);
  refuses("channels", 2);
  refuses("coefficients", 100000);
  refuses("air", nullptr);
}

}  // namespace
}  // namespace prelight
