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
    bake({"--ao"});
  }

  /// Writes baked.glb.
  void bake(const std::vector<std::string>& techniques) const {
    std::vector<std::string> command = {"bake", "scene.glb", "-o", "baked.glb", "--rays", "16"};
    command.insert(command.end(), techniques.begin(), techniques.end());
    prelightDone(command);
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

void paint(nlohmann::ordered_json& json) {
  json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 1.0};
}

void dim(nlohmann::ordered_json& json) {
  json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 3.0;
}

TEST_F(CliStaleBake, ColourChangedSince_MattersToBounces) {
  change(paint);
  // A bake of occlusion alone does not depend on materials.
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
  bake({"--ao", "--sh", "2", "--bounces", "1"});
  change(paint);
  EXPECT_THAT(warningsOf("changed.glb"),
              HasSubstr("the scene's materials changed after it was baked: sh in its bake does not"));
}

TEST_F(CliStaleBake, HolesChangedSince_MatterToOcclusion) {
  change([](nlohmann::ordered_json& json) {
    json["materials"][0]["alphaMode"] = "MASK";
    json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.2;
  });
  EXPECT_THAT(warningsOf("changed.glb"), HasSubstr(std::string("the scene's materials ") + stale));
}

TEST_F(CliStaleBake, NamesAndLightsChangedSince_DoNotMatterToOcclusion) {
  change([](nlohmann::ordered_json& json) {
    json["nodes"][1]["name"] = "Ceiling";
    dim(json);
  });
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
}

TEST_F(CliStaleBake, LightsChangedSince_MatterToTheirLightAlone) {
  bake({"--ao", "--lightmap", "--texel-size", "0.2", "--photons", "1000"});
  EXPECT_THAT(warningsOf("baked.glb"), Not(HasSubstr(stale)));
  std::filesystem::copy(path("baked.lightmap.exr"), path("changed.lightmap.exr"));
  change(dim);
  EXPECT_THAT(warningsOf("changed.glb"),
              HasSubstr("the scene's lights changed after it was baked: radiosity and "
                        "lightmap in its bake do not fit it"));
  expectFailure(badInput, {"export", "changed.glb", "-o", "plain.glb"}, {"lights", stale, "--allow-stale"});
  prelightDone({"export", "changed.glb", "-o", "plain.glb", "--as", "occlusion"});
}

TEST_F(CliStaleBake, PixelsChangedSince_MatterToBounces) {
  GlbScene textured = floorAndRoof();
  auto& json = textured.json;
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json["accessors"].size() - 1;
  json["images"] = {{{"uri", "first.png"}}};
  json["textures"] = {{{"source", 0}}};
  json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  prelightDone({"render", "scene.glb", "-o", "first.png", "--shading", "phong", "--size", "16x16"});
  prelightDone({"render", "scene.glb", "-o", "second.png", "--shading", "phong", "--size", "8x8"});
  writeFile("scene.glb", textured.bytes());
  const auto exchange = [](nlohmann::ordered_json& changed) {
    changed["images"][0] = {{"uri", "second.png"}};
  };
  bake({"--ao"});
  change(exchange);
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
  bake({"--sh", "2", "--bounces", "1"});
  EXPECT_THAT(warningsOf("baked.glb"), Not(HasSubstr(stale)));
  change(exchange);
  EXPECT_THAT(warningsOf("changed.glb"), HasSubstr(std::string("the scene's textures ") + stale));
}

/// Earlier versions wrote this fingerprint for every bake.
TEST_F(CliStaleBake, FingerprintOfGeometryAndMaterialsAlone_IsStillUnderstood) {
  bake({"--sh", "2", "--bounces", "1"});
  const auto asEarlier = [](nlohmann::ordered_json& json) {
    auto& fingerprint = json["extensions"]["PRELIGHT_transfer"]["fingerprint"];
    fingerprint = {{"geometry", fingerprint["geometry"]}, {"materials", fingerprint["materials"]}};
  };
  change(asEarlier);
  EXPECT_THAT(warningsOf("changed.glb"), Not(HasSubstr(stale)));
  change([&](nlohmann::ordered_json& json) {
    asEarlier(json);
    dim(json);
    paint(json);
  });
  EXPECT_THAT(warningsOf("changed.glb"), HasSubstr(std::string("the scene's materials ") + stale));
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
