#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene/gltf/load/loader.h"
#include "scene/light_profile.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

constexpr const char* lamp = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n0 90\n0\n8 4\n";

/// Writes a .gltf with a lamp at its first node, beside lamp.ies.
std::string writeScene(const test::TemporaryFolder& folder, const std::string& text, const Json& node,
                       const char* uri = "lamp.ies") {
  test::writeBytes(folder / "lamp.ies", text);
  GltfDocument document = test::triangleDocument();
  document.json["extensionsUsed"] = {"EXT_lights_ies"};
  document.json["extensions"]["EXT_lights_ies"]["lights"] =
      Json::array({{{"uri", uri}}, {{"uri", "none.ies"}}});
  document.json["nodes"][0]["rotation"] = {0.7071067811865476, 0, 0, 0.7071067811865476};
  document.json["nodes"][0]["extensions"]["EXT_lights_ies"] = node;
  document.json.erase("buffers");
  for (const char* part : {"meshes", "accessors", "bufferViews", "materials"}) document.json.erase(part);
  document.json["nodes"][0].erase("mesh");
  test::writeBytes(folder / "a.gltf", document.json.dump());
  return (folder / "a.gltf").string();
}

TEST(LoadProfiles, NodesLamp_IsProfileTimesMultiplierAndColour) {
  const test::TemporaryFolder folder;
  Warnings warnings;
  const std::string path =
      writeScene(folder, lamp, {{"light", 0}, {"multiplier", 2.5}, {"color", {1, 0.5, 0}}});
  const GltfDocument document = readGltf(path, warnings);
  const Scene scene = loadScene(document, warnings);
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.intensity, glm::vec3(2.5f, 1.25f, 0.0f));
  EXPECT_NEAR(glm::length(light.direction - glm::dvec3(0, 1, 0)), 0.0,
              1e-12);  // -Z turned a quarter about +X.
  EXPECT_NEAR(glm::length(light.side - glm::dvec3(1, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(profileTowards(light, {0, 1, 0}), 8.0, 1e-9);
  EXPECT_NEAR(profileTowards(light, glm::normalize(glm::dvec3(1, 1, 0))), 6.0, 1e-9);
  EXPECT_EQ(profileTowards(light, {0, -1, 0}), 0.0);
  // The other profile is missing, but no node uses it.
  EXPECT_TRUE(test::anyContains(warnings, "none.ies"));
}

TEST(LoadProfiles, WhatIsWritten_CarriesTheProfile) {
  const test::TemporaryFolder folder;
  Warnings warnings;
  const GltfDocument document = readGltf(writeScene(folder, lamp, {{"light", 0}}), warnings);
  writeGlb(folder / "b.glb", document);
  std::filesystem::remove(folder / "lamp.ies");
  const Scene scene = loadScene(readGltf(folder / "b.glb", warnings), warnings);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(profileTowards(scene.lights[0], {0, 1, 0}), 8.0, 1e-9);
}

/// A scene with `count` profile entries that cycle through `uris`, each used by a node.
GltfDocument manyEntries(const test::TemporaryFolder& folder, std::size_t count,
                         const std::vector<std::string>& uris, const std::string& text, Warnings& warnings) {
  const std::string path = writeScene(folder, text, {{"light", 0}});
  Json json = Json::parse(std::ifstream(path));
  for (const std::string& uri : uris) test::writeBytes(folder / uri, text);
  Json lights = Json::array(), children = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    lights.push_back({{"uri", uris[i % uris.size()]}});
    Json node;
    node["extensions"]["EXT_lights_ies"] = {{"light", i}};
    children.push_back(json["nodes"].size());
    json["nodes"].push_back(node);
  }
  json["extensions"]["EXT_lights_ies"]["lights"] = lights;
  json["nodes"][0]["children"] = children;
  test::writeBytes(path, json.dump());
  return readGltf(path, warnings);
}

TEST(LoadProfiles, EntriesOfOneFile_ShareItsBytesAndProfile) {
  const test::TemporaryFolder folder;
  Warnings warnings;
  const GltfDocument document = manyEntries(folder, 1000, {"lamp.ies"}, lamp, warnings);
  EXPECT_LT(document.bin.size(), 200u);
  EXPECT_EQ(document.json["bufferViews"].size(), 1u);
  const Scene scene = loadScene(document, warnings);
  ASSERT_EQ(scene.lights.size(), 1001u);
  for (const Light& light : scene.lights) EXPECT_EQ(light.profile, scene.lights[0].profile);
}

TEST(LoadProfiles, TooManyIntensitiesOrBytesTogether_AreRefused) {
  std::string large = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 1001 1001 1 2 0 0 0 1 1 1\n";
  for (int i = 0; i <= 1000; ++i) large += std::to_string(0.18 * i) + " ";
  for (int i = 0; i <= 1000; ++i) large += std::to_string(0.36 * i) + " ";
  for (int i = 0; i < 1001 * 1001; ++i) large += "1 ";
  const std::vector<std::string> uris = {"a.ies", "b.ies", "c.ies", "d.ies", "e.ies"};
  const auto errorOf = [&](const std::string& text) {
    return test::inputErrorOf([&] {
      const test::TemporaryFolder folder;
      Warnings warnings;
      (void)loadScene(manyEntries(folder, uris.size(), uris, text, warnings), warnings);
    });
  };
  EXPECT_THAT(errorOf(large), testing::AllOf(HasSubstr("/extensions/EXT_lights_ies/lights/4"),
                                             HasSubstr("5010005 intensities"),
                                             HasSubstr("expected at most 4194304 together")));
  EXPECT_THAT(errorOf(lamp + std::string((1 << 24) - 100, ' ')),
              testing::AllOf(HasSubstr("/extensions/EXT_lights_ies/lights/4/uri"),
                             HasSubstr("expected at most 67108864 together")));
}

TEST(LoadProfiles, BrokenOrMissingOnesThatAreUsed_AreErrors) {
  const test::TemporaryFolder folder;
  const auto errorOf = [&](const std::string& text, const Json& node, const char* uri = "lamp.ies") {
    return test::inputErrorOf([&] {
      Warnings warnings;
      (void)loadScene(readGltf(writeScene(folder, text, node, uri), warnings), warnings);
    });
  };
  EXPECT_THAT(
      errorOf("nothing", {{"light", 0}}),
      testing::AllOf(HasSubstr("/extensions/EXT_lights_ies/lights/0"), HasSubstr("no photometric profile")));
  EXPECT_THAT(errorOf(lamp, {{"light", 1}}), HasSubstr("none.ies"));
  EXPECT_THAT(errorOf(lamp, {{"light", 2}}), HasSubstr("light profile"));
  EXPECT_THAT(errorOf(lamp, {{"light", 0}, {"multiplier", 1e15}}), HasSubstr("dim the lamp"));
  EXPECT_THAT(errorOf(lamp, {{"light", 0}}, "../lamp.ies"), HasSubstr("../lamp.ies"));
}

}  // namespace
}  // namespace prelight
