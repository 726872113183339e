#include <gtest/gtest.h>

#include <filesystem>

#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

GltfDocument documentOf(const char* nodes, const char* scenes) {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"] = Json::parse(nodes);
  document.json["scenes"] = Json::parse(scenes);
  return document;
}

/// X of the origin of each drawn node.
std::vector<double> placesOf(const Scene& scene) {
  std::vector<double> places;
  for (const MeshNode& node : scene.meshNodes) places.push_back(node.transforms[0][3][0]);
  return places;
}

TEST(ListedChildren, ParentThatNoSceneDraws_LeavesTheChildARoot) {
  Warnings warnings;
  const Scene scene = test::reload(documentOf(R"([{"children": [1], "translation": [5, 0, 0]},
                                  {"mesh": 0, "translation": [2, 0, 0], "children": [2]},
                                  {"mesh": 0, "translation": [1, 0, 0]}])",
                                              R"([{"nodes": [1]}])"),
                                   warnings);
  EXPECT_EQ(placesOf(scene), (std::vector<double>{2.0, 3.0}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("/scenes/0/nodes: node 1 is a child of node 0"), std::string::npos)
      << warnings[0];
}

TEST(ListedChildren, AncestorInTheSameScene_DrawsItOnce) {
  Warnings warnings;
  const Scene scene =
      test::reload(documentOf(R"([{"children": [1], "translation": [5, 0, 0]}, {"children": [2]},
                                  {"mesh": 0, "translation": [2, 0, 0]}])",
                              R"([{"nodes": [0, 1, 2]}])"),
                   warnings);
  EXPECT_EQ(placesOf(scene), (std::vector<double>{7.0}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("also for 1 more node"), std::string::npos) << warnings[0];
}

TEST(ListedChildren, ParentOfAnotherScene_IsRefused) {
  const GltfDocument document =
      documentOf(R"([{"children": [1]}, {"mesh": 0}])", R"([{"nodes": [0]}, {"nodes": [1]}])");
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { test::reload(document, warnings); });
  EXPECT_NE(message.find("/scenes/1/nodes: node 1 is a child of node 0"), std::string::npos) << message;
}

TEST(ListedChildren, WhatWasRead_IsWrittenWithoutThem) {
  Warnings warnings;
  const test::TemporaryFolder folder;
  const std::filesystem::path first = folder / "first.glb", second = folder / "second.glb";
  writeGlb(first, documentOf(R"([{"children": [1]}, {"mesh": 0}])", R"([{"nodes": [1]}])"));
  writeGlb(second, readGltf(first, warnings));
  warnings.clear();
  EXPECT_EQ(placesOf(loadScene(readGltf(second, warnings), warnings)), (std::vector<double>{0.0}));
  EXPECT_TRUE(warnings.empty());
}

TEST(ListedChildren, LongChainAllListed_IsSettledAtOnce) {
  constexpr std::size_t count = 100'000;
  GltfDocument document = test::triangleDocument();
  Json nodes = Json::array(), roots = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    nodes.push_back(i + 1 < count ? Json{{"children", {i + 1}}} : Json{{"mesh", 0}});
    roots.push_back(i);
  }
  document.json["nodes"] = nodes;
  document.json["scenes"] = Json::array({{{"nodes", roots}}});
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshNodes.size(), 1u);
  EXPECT_EQ(warnings.size(), 1u);
}

}  // namespace
}  // namespace prelight
