#include <gmock/gmock.h>

#include <cmath>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

/// A floor under a roof with a point light.
class CliTechniques : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  GlbScene bake(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "scene.glb", "-o", "out.glb", "--rays", "64"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    prelightDone(arguments);
    return parseGlb(readFile("out.glb"));
  }

  static const nlohmann::ordered_json& root(const GlbScene& scene) {
    return scene.json.at("extensions").at("PRELIGHT_transfer");
  }

  static const nlohmann::ordered_json& baked(const GlbScene& scene, std::size_t node = 0) {
    return scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
  }
};

TEST_F(CliTechniques, AllAtOnce_ComeFromOneCast) {
  const std::vector<std::string> sh = {"--sh", "3", "--bounces", "1"};
  const auto rays = root(bake(sh)).at("rays");
  const GlbScene all = bake(
      {"--ao", "--sh", "3", "--ch", "3", "--haar", "8", "--glossy", "2", "--light-groups", "--bounces", "1"});
  EXPECT_EQ(root(all).at("rays"), rays);
  for (std::size_t node = 0; node < 2; ++node)
    for (const char* member : {"ao", "bentNormal", "sh", "ch", "haar", "glossy", "lightGroups"})
      EXPECT_TRUE(baked(all, node).contains(member)) << member;
  EXPECT_EQ(baked(all).at("haar").at("faceSize"), 8);
  EXPECT_EQ(root(all).at("lightGroups").size(), 1u);
  for (const float value : floatAccessor(all, baked(all).at("glossy").at("matrices")))
    EXPECT_TRUE(std::isfinite(value));
}

TEST_F(CliTechniques, Compressed_ReplacesTheCoefficients) {
  const GlbScene scene = bake({"--sh", "4", "--compress", "band8"});
  EXPECT_FALSE(baked(scene).contains("sh"));
  EXPECT_TRUE(baked(scene).contains("shCompressed"));
  EXPECT_EQ(root(scene).at("shCompressed").at("method"), "band8");
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--haar", "8", "--compress", "half"},
                {"--compress", "--sh"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--haar", "8", "--compress", "auto:half"},
                {"--compress", "--sh"});
}

TEST_F(CliTechniques, CompressAuto_MakesEverythingSmallAndIsDrawnAlike) {
  const std::vector<std::string> techniques = {"--cones", "--horizons", "4", "--sh",
                                               "3",       "--haar",     "8", "--vo"};
  std::vector<std::string> small = techniques;
  small.insert(small.end(), {"--compress", "auto", "--report", "report.json"});
  bake(techniques);
  prelightDone({"render", "out.glb", "-o", "full.exr", "--shading", "haar", "--size", "32x32"});
  const GlbScene scene = bake(small);
  for (const char* member : {"ao", "bentNormal", "aperture", "horizons", "haar"}) {
    EXPECT_FALSE(baked(scene).contains(member)) << member;
    EXPECT_TRUE(baked(scene).at("quantized").contains(member)) << member;
  }
  EXPECT_TRUE(baked(scene).contains("shCompressed"));
  EXPECT_TRUE(baked(scene).at("vo").contains("bytes"));
  const std::string info = prelightDone({"info", "out.glb"}).output;
  EXPECT_THAT(info, testing::HasSubstr("horizons in 4 sectors of azimuth, quantised; "));
  EXPECT_THAT(info, testing::HasSubstr(", 8 bytes per vertex"));
  const auto listed = nlohmann::json::parse(prelightDone({"info", "out.glb", "--json"}).output).at("baked");
  EXPECT_EQ(listed.at("aperture").at("bytes").get<int>() * 3, listed.at("bentNormal").at("bytes").get<int>());
  for (const char* part : {"compression of Haar: ", "compression of horizons: ", "compression of ao: "})
    EXPECT_THAT(readFile("report.json"), testing::HasSubstr(part));
  prelightDone({"render", "out.glb", "-o", "small.exr", "--shading", "haar", "--size", "32x32"});
  const auto difference =
      nlohmann::json::parse(prelightDone({"compare", "small.exr", "full.exr", "--json"}).output);
  EXPECT_LT(difference.at("picture").at("relMSE").get<double>(), 1e-4);
  EXPECT_EQ(root(bake({"--sh", "3", "--compress", "auto:pca:2"})).at("shCompressed").at("method"), "pca");
}

TEST_F(CliTechniques, Compressed_VolumeIsAsWell) {
  const GlbScene scene =
      bake({"--sh", "4", "--volume", "4", "--compress", "half", "--report", "report.json"});
  const auto& volume = root(scene).at("volume");
  EXPECT_FALSE(volume.contains("coefficients"));
  EXPECT_EQ(volume.at("coefficientsCompressed").at("method"), "half");
  EXPECT_THAT(readFile("report.json"), testing::HasSubstr("compression of the volume: "));
  EXPECT_THAT(prelightDone({"info", "out.glb"}).output, testing::HasSubstr("as half"));
}

TEST_F(CliTechniques, LightGroups_AreNamedAndChecked) {
  const GlbScene scene = bake({"--light-group", "all=*"});
  EXPECT_EQ(root(scene).at("lightGroups").at(0).at("name"), "all");
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--light-group", "lamps=Nothing*"},
                {"lamps", "empty"});
  GlbScene dark = floorAndRoof();
  dark.json.erase("extensions");
  for (auto& node : dark.json.at("nodes")) node.erase("extensions");
  writeFile("dark.glb", dark.bytes());
  expectFailure(badInput, {"bake", "dark.glb", "-o", "x.glb", "--light-groups"}, {"no light"});
  EXPECT_FALSE(std::filesystem::exists(path("x.glb")));
}

TEST_F(CliTechniques, Limits_ThatLeaveNothing_AreRefused) {
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--ao", "--near", "2", "--far", "1"},
                {"--near", "--far"});
}

TEST_F(CliTechniques, Info_SaysWhatEachWouldDo) {
  const ProcessResult result =
      prelight({"info", "scene.glb", "--haar", "16", "--glossy", "3", "--bounces", "1"});
  EXPECT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("6 x 16 x 16"));
  EXPECT_THAT(result.output, HasSubstr("SH transfer of order 5"));
}

}  // namespace
}  // namespace prelight::test
