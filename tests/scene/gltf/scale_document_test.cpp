#include "scene/gltf/load/scale_document.h"

#include <gtest/gtest.h>

#include "prelight/load.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

constexpr double small = 0.001;

GltfDocument documentOfLengths() {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"] = Json::parse(R"([
    {"name": "root", "children": [1, 2, 3], "translation": [100, 200, 300]},
    {"name": "mesh", "mesh": 0, "scale": [10, 10, 10]},
    {"camera": 0, "translation": [0, 0, 50]},
    {"translation": [7, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "other", "mesh": 0}])");
  document.json["scenes"] = Json::parse(R"([{"nodes": [0]}, {"nodes": [0, 4]}])");
  document.json["scene"] = 0;
  document.json["cameras"] = Json::parse(
      R"([{"type": "orthographic", "orthographic": {"xmag": 200, "ymag": 300, "znear": 1, "zfar": 9000}}])");
  document.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "point", "intensity": 3, "range": 400}])");
  document.json["materials"][0]["extensions"]["KHR_materials_volume"] = {{"attenuationDistance", 25.0},
                                                                         {"thicknessFactor", 1.0}};
  return document;
}

TEST(ScaleDocument, PlacesAndLengths_AreMultipliedAndLightIsNot) {
  GltfDocument document = documentOfLengths();
  Warnings warnings;
  const Scene before = test::reload(document, warnings);
  scaleDocument(document, small);
  const Scene after = test::reload(document, warnings);
  ASSERT_EQ(after.meshNodes.size(), 1u);
  const glm::dmat4& was = before.meshNodes[0].transforms[0];
  const glm::dmat4& is = after.meshNodes[0].transforms[0];
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(is[c][r], small * was[c][r], 1e-12);
  const Camera& camera = after.cameras.at(0);
  EXPECT_NEAR(camera.world[3].z, small * 350.0, 1e-9);
  EXPECT_NEAR(camera.xMag, 0.2, 1e-12);
  EXPECT_NEAR(camera.yMag, 0.3, 1e-12);
  EXPECT_NEAR(camera.zNear, 0.001, 1e-12);
  EXPECT_NEAR(camera.zFar, 9.0, 1e-9);
  const Light& light = after.lights.at(0);
  EXPECT_NEAR(light.position.x, small * 107.0, 1e-9);
  EXPECT_NEAR(light.range, 0.4, 1e-6);
  EXPECT_EQ(light.intensity, before.lights.at(0).intensity);
  EXPECT_NEAR(after.materials.at(0).attenuationDistance, 0.025, 1e-6);
}

TEST(ScaleDocument, NodesOfTheFile_KeepTheirNumbersAndOtherScenesAreScaledToo) {
  GltfDocument document = documentOfLengths();
  const Json before = document.json["nodes"];
  scaleDocument(document, small);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(document.json["nodes"][i], before[i]);
  ASSERT_EQ(document.json["nodes"].size(), before.size() + 2);  // A parent for each of the two roots.
  document.json["scene"] = 1;
  Warnings warnings;
  const Scene other = test::reload(document, warnings);
  ASSERT_EQ(other.meshNodes.size(), 2u);
  EXPECT_NEAR(other.meshNodes[1].transforms[0][0][0], small, 1e-15);
}

TEST(ScaleDocument, FileWithoutScenes_IsScaledAsOne) {
  GltfDocument document = documentOfLengths();
  document.json.erase("scenes");
  document.json.erase("scene");
  scaleDocument(document, small);
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  ASSERT_EQ(scene.meshNodes.size(), 2u);
  EXPECT_NEAR(scene.meshNodes[0].transforms[0][0][0], 10.0 * small, 1e-12);
}

}  // namespace
}  // namespace prelight
