#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A floor under a roof with a point light, baked.
class CliExport : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
    prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--lightmap", "--ao", "--texel-size", "0.1",
                  "--rays", "16", "--photons", "1000"});
  }
};

TEST_F(CliExport, Folder_HoldsSceneMapsAndTexts) {
  const auto report =
      nlohmann::json::parse(prelightDone({"export", "baked.glb", "-o", "out", "--json"}).output);
  EXPECT_EQ(report["as"], "lightmap");
  EXPECT_EQ(report["lights"]["count"], 1);
  EXPECT_EQ(report["files"].size(), 7u);
  for (const auto& file : report["files"])
    EXPECT_TRUE(std::filesystem::exists(path("out/" + file["name"].get<std::string>()))) << file;
  const GlbScene scene = parseGlb(readFile("out/baked.glb"));
  EXPECT_THAT(scene.json.dump(), HasSubstr("MOZ_lightmap"));
  EXPECT_THAT(scene.json.dump(), Not(HasSubstr("PRELIGHT_transfer")));
  EXPECT_THAT(scene.json.dump(), Not(HasSubstr("KHR_lights_punctual")));
}

TEST_F(CliExport, OneFile_HoldsEverything) {
  prelightDone({"export", "baked.glb", "-o", "plain.glb", "--as", "vertex-light", "--lights", "mark"});
  const std::string json = parseGlb(readFile("plain.glb")).json.dump();
  EXPECT_THAT(json, HasSubstr("COLOR_0"));
  EXPECT_THAT(json, HasSubstr("\"baked\":true"));
  prelightDone({"info", "plain.glb"});
}

TEST_F(CliExport, WithoutALightMap_IsOcclusion) {
  prelightDone({"bake", "scene.glb", "-o", "ao.glb", "--ao", "--rays", "16"});
  const auto report =
      nlohmann::json::parse(prelightDone({"export", "ao.glb", "-o", "out.glb", "--json"}).output);
  EXPECT_EQ(report["as"], "occlusion");
}

TEST_F(CliExport, Targets_HaveTheirLoaders) {
  prelightDone({"export", "baked.glb", "-o", "three", "--target", "three"});
  EXPECT_THAT(readFile("three/prelight_light_map.js"), HasSubstr("export async function loadLightMap"));
  EXPECT_THAT(readFile("three/README.md"), HasSubstr("baked.lightmap.ktx2"));
  prelightDone({"export", "baked.glb", "-o", "blender", "--target", "blender"});
  EXPECT_THAT(readFile("blender/load_in_blender.py"), HasSubstr("NAME = \"baked\""));
}

TEST_F(CliExport, AfterABake_IsTheSameInOneCommand) {
  const auto report = nlohmann::json::parse(
      prelightDone({"bake", "scene.glb", "-o", "lit.glb", "--lightmap", "--texel-size", "0.1", "--rays", "16",
                    "--photons", "1000", "--export", "lit", "--export-target", "godot", "--json"})
          .output);
  EXPECT_EQ(report["export"]["target"], "godot");
  EXPECT_THAT(readFile("lit/prelight_light_map.gd"), HasSubstr("extends Node3D"));
  EXPECT_TRUE(std::filesystem::exists(path("lit/lit.glb")));
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "no.glb", "--export", "no", "--export-target", "maya"},
                {"--export-target maya", "godot"});
  EXPECT_FALSE(std::filesystem::exists(path("no.glb"))) << "it is refused before the bake";
}

TEST_F(CliExport, Probes_AreNumbersWithADescription) {
  const auto report =
      nlohmann::json::parse(prelightDone({"export", "baked.glb", "-o", "air", "--as", "probes", "--probes",
                                          "3", "--rays", "256", "--json"})
                                .output);
  EXPECT_EQ(report["as"], "probes");
  for (const auto& file : report["files"])
    EXPECT_TRUE(std::filesystem::exists(path("air/" + file["name"].get<std::string>()))) << file;
  const auto description = nlohmann::json::parse(readFile("air/baked.probes.json"));
  EXPECT_EQ(description["order"], 3);
  expectFailure(badUsage, {"export", "baked.glb", "-o", "air.glb", "--as", "probes"}, {"air.glb", "folder"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "none", "--as", "volume"}, {"no volume", "--volume"});
  EXPECT_FALSE(std::filesystem::exists(path("none")));
}

TEST_F(CliExport, Sky_IsTheScenesForProgramsThatReadIt) {
  const auto report = nlohmann::json::parse(
      prelightDone({"export", "baked.glb", "-o", "sky.glb", "--env", "studio", "--json"}).output);
  EXPECT_GE(report["sky"]["pictures"], 6);
  const auto light = parseGlb(readFile("sky.glb")).json["extensions"]["EXT_lights_image_based"]["lights"][0];
  EXPECT_EQ(light["irradianceCoefficients"][0], nlohmann::ordered_json({0.0, 0.0, 0.0}))
      << "the light map has it";
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--target", "three", "--env", "studio"},
                {"--env", "--target"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--env", "studio", "--env", "studio"},
                {"--env", "2 skies"});
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(CliExport, BadInput_IsRefusedByNameAndLeavesNothing) {
  expectFailure(badInput, {"export", "scene.glb", "-o", "out"},
                {"scene.glb", "carries no bake", "prelight bake"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--target", "maya"},
                {"--target maya", "gltf, three, blender"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--as", "map"}, {"--as map", "lightmap"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--lights", "off"},
                {"--lights off", "remove"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out.gltf"}, {"out.gltf", ".glb"});
  expectFailure(failed, {"export", "baked.glb", "-o", "no/such/folder"}, {"no/such/folder"});
  std::filesystem::remove(path("baked.lightmap.exr"));
  expectFailure(badInput, {"export", "baked.glb", "-o", "out"}, {"baked.lightmap.exr", "no such file"});
}

/// The .glb and the first maps fit on the disk; the largest map does not.
TEST_F(CliExport, DiskWithRoomForAPart_LeavesWhatWasThere) {
  prelightDone({"export", "baked.glb", "-o", "out"});
  const auto listed = [&] {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::directory_iterator(path("out")))
      contents[entry.path().filename().string()] = readFile("out/" + entry.path().filename().string());
    return contents;
  };
  const auto before = listed();
  std::size_t largest = 0;
  for (const auto& [name, bytes] : before) largest = std::max(largest, bytes.size());
  const std::string limit = std::to_string(largest / 1024);
  const ProcessResult result =
      runProcess({"/bin/bash", "-c", "ulimit -f " + limit + "; $P export baked.glb -o out --lights keep"},
                 {.directory = path(""), .environment = {{"P", PRELIGHT_PROGRAM}}});
  EXPECT_EQ(result.exitCode, 1) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("cannot write"));
  EXPECT_EQ(listed(), before);
}

TEST_F(CliExport, BakeWithoutTheForm_IsAUsageError) {
  prelightDone({"bake", "scene.glb", "-o", "sh.glb", "--sh", "2", "--rays", "16"});
  expectFailure(badUsage, {"export", "sh.glb", "-o", "out.glb"},
                {"--as lightmap", "no light map", "--lightmap"});
  expectFailure(badUsage, {"export", "sh.glb", "-o", "out.glb", "--as", "vertex-occlusion"},
                {"no ambient occlusion", "--ao"});
  expectFailure(badUsage, {"export", "sh.glb", "-o", "out", "--as", "transfer"},
                {"--as transfer", "--target raw"});
  expectFailure(badUsage, {"export", "sh.glb", "-o", "out", "--target", "three", "--as", "lightmap"},
                {"--as lightmap", "no light map"});
  expectFailure(badUsage, {"export", "sh.glb", "-o", "out", "--target", "three", "--lights", "mark"},
                {"--lights", "--as lightmap"});
  prelightDone({"export", "sh.glb", "-o", "out", "--target", "raw"});
  EXPECT_THAT(readFile("out/sh.export.json"), HasSubstr("\"as\": \"transfer\""));
}

TEST_F(CliExport, WhatIsTakenAndLeftOut_IsSaid) {
  prelightDone({"bake", "scene.glb", "-o", "both.glb", "--sh", "2", "--ao", "--rays", "16"});
  EXPECT_THAT(
      prelightDone({"export", "both.glb", "-o", "out.glb", "--as", "vertex-occlusion"}).output,
      AllOf(HasSubstr("took       AO"), HasSubstr("left out   SH of order 2"), HasSubstr("--target three")));
  EXPECT_EQ(prelightDone({"export", "both.glb", "-o", "quiet", "--target", "three", "--quiet"}).output, "");
  const auto report = nlohmann::json::parse(
      prelightDone({"export", "both.glb", "-o", "three", "--target", "three", "--json"}).output);
  EXPECT_EQ(report["as"], "transfer");
  EXPECT_THAT(report["taken"][0], HasSubstr("SH of order 2"));
  EXPECT_THAT(report["leftOut"][0]["what"], HasSubstr("AO"));
  EXPECT_THAT(readFile("three/prelight.js"), HasSubstr("class Relighter"));
}

TEST_F(CliExport, ThatFails_LeavesNoFolder) {
  const std::set<std::string> before = files();
  prelight({"export", "baked.glb", "-o", "out", "--as", "probes", "--env", "missing.hdr"});
  EXPECT_EQ(files(), before);
  expectFailure(failed, {"export", "baked.glb", "-o", "nowhere/out"}, {"-o nowhere/out", "does not exist"});
}

}  // namespace
}  // namespace prelight::test
