#include "export/exported_lights.h"

#include <gtest/gtest.h>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// The built-in scene `shapes` with an animation of its lamp's intensity.
GltfDocument litScene() {
  GltfDocument document = makeBuiltinScene("shapes");
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int values = test::appendFloats(document, {1, 2}, "SCALAR");
  document.json["animations"] = Json::array(
      {{{"samplers", Json::array({{{"input", times}, {"output", values}}})},
        {"channels",
         Json::array({{{"sampler", 0},
                       {"target",
                        {{"path", "pointer"},
                         {"extensions",
                          {{"KHR_animation_pointer",
                            {{"pointer", "/extensions/KHR_lights_punctual/lights/0/intensity"}}}}}}}}})}}});
  return document;
}

TEST(ExportedLights, Removed_LeaveNothingThatNamesThem) {
  GltfDocument document = litScene();
  EXPECT_EQ(exportLights(document, BakedLights::Remove), 1u);
  EXPECT_EQ(document.json.dump().find("KHR_lights_punctual"), std::string::npos);
  EXPECT_FALSE(document.json.contains("animations"));
  Warnings warnings;
  EXPECT_TRUE(loadScene(document, warnings).lights.empty());
}

TEST(ExportedLights, Marked_StayAndSaySo) {
  GltfDocument document = litScene();
  EXPECT_EQ(exportLights(document, BakedLights::Mark), 1u);
  const Json& light = document.json["extensions"]["KHR_lights_punctual"]["lights"][0];
  EXPECT_EQ(light["extras"]["prelight"]["baked"], true);
  EXPECT_TRUE(document.json.contains("animations"));
}

TEST(ExportedLights, Kept_AreTheSame) {
  GltfDocument document = litScene();
  const Json before = document.json;
  exportLights(document, BakedLights::Keep);
  EXPECT_EQ(document.json, before);
}

}  // namespace
}  // namespace prelight
