#include <gmock/gmock.h>

#include <functional>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* stale = "changed after it was baked";

/// A floor under a roof, baked and then changed.
class CliStaleBake : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
    prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--ao", "--rays", "16"});
  }

  /// Writes changed.glb.
  void change(const std::function<void(nlohmann::ordered_json&)>& edit) const {
    GlbScene scene = parseGlb(readFile("baked.glb"));
    edit(scene.json);
    writeFile("changed.glb", scene.bytes());
  }

  std::string warningsOf(const std::string& file) const {
    return prelightDone({"render", file, "-o", "picture.png", "--size", "16x9"}).errors;
  }
};

TEST_F(CliStaleBake, SceneAsItWasBaked_IsTakenWithoutAWord) {
  EXPECT_THAT(warningsOf("baked.glb"), Not(HasSubstr(stale)));
  prelightDone({"export", "baked.glb", "-o", "plain.glb"});
}

TEST_F(CliStaleBake, BuiltinScaledAndPosedScenes_AreAsTheyWereBaked) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  const std::vector<std::vector<std::string>> ways = {{}, {"--scale", "0.0371"}, {"--at", "0.4"}};
  for (const std::vector<std::string>& way : ways) {
    std::vector<std::string> bake = {"bake", "swing.glb", "-o", "swung.glb", "--ao", "--rays", "16"};
    bake.insert(bake.end(), way.begin(), way.end());
    prelightDone(bake);
    EXPECT_THAT(prelightDone({"info", "swung.glb"}).errors, Not(HasSubstr(stale)));
  }
}

TEST_F(CliStaleBake, NodeMovedSince_IsAWarningOfPicturesAndRefusedByExport) {
  change([](nlohmann::ordered_json& json) {
    auto& node = json["nodes"][1];
    node.erase("matrix");
    node["translation"] = {0.25, 1.5, 0.0};
  });
  EXPECT_THAT(warningsOf("changed.glb"), HasSubstr(std::string("the scene's geometry ") + stale));
  EXPECT_THAT(prelightDone({"info", "changed.glb"}).errors, HasSubstr(stale));
  expectFailure(badInput, {"export", "changed.glb", "-o", "plain.glb"},
                {"changed.glb", "geometry", stale, "--allow-stale"});
  prelightDone({"export", "changed.glb", "-o", "plain.glb", "--allow-stale"});
}

TEST_F(CliStaleBake, MaterialChangedSince_IsNamed) {
  change([](nlohmann::ordered_json& json) {
    json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 1.0};
  });
  EXPECT_THAT(warningsOf("changed.glb"), HasSubstr(std::string("the scene's materials ") + stale));
}

TEST_F(CliStaleBake, NamesAndLightsChangedSince_DoNotMatter) {
  change([](nlohmann::ordered_json& json) {
    json["nodes"][1]["name"] = "Ceiling";
    json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 3.0;
  });
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
}

TEST_F(CliStaleBake, FileWithoutAFingerprint_IsTakenAsItIs) {
  change([](nlohmann::ordered_json& json) {
    json["extensions"]["PRELIGHT_transfer"].erase("fingerprint");
    json["nodes"][1].erase("matrix");
    json["nodes"][1]["translation"] = {0.25, 1.5, 0.0};
  });
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
  prelightDone({"export", "changed.glb", "-o", "plain.glb"});
}

}  // namespace
}  // namespace prelight::test
