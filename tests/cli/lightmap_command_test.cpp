#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

constexpr int badUsage = 2, badInput = 3;

/// A floor under a roof with a point light.
class CliLightMap : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  ProcessResult bake(const std::string& output, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "scene.glb", "-o", output, "--lightmap"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelightDone(arguments);
  }
};

TEST_F(CliLightMap, Bake_WritesCoordinatesAndAPicture) {
  const ProcessResult result = bake("out.glb", {"--texel-size", "0.1", "--report", "report.json"});
  EXPECT_THAT(result.output, HasSubstr("light map"));
  const GlbScene scene = parseGlb(readFile("out.glb"));
  for (std::size_t node = 0; node < 2; ++node) {
    const auto& entry =
        scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
    EXPECT_EQ(entry.size(), 2u);
    EXPECT_FALSE(floatAccessor(scene, entry.at("irradiance")).empty());
    EXPECT_EQ(entry.at("lightmap").at("image"), "out.lightmap.exr");
    for (const float value : floatAccessor(scene, entry.at("lightmap").at("texCoord"))) {
      EXPECT_GE(value, 0.0f);
      EXPECT_LE(value, 1.0f);
    }
  }
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  EXPECT_GT(report.at("lightMap").at("texels"), 10);
  EXPECT_EQ(report.at("options").at("lightMap").at("texelSize"), 0.1);
  EXPECT_FALSE(readFile("out.lightmap.exr").empty());
}

TEST_F(CliLightMap, Report_RepeatsTheMapsOptions) {
  bake("out.glb", {"--texel-size", "0.5", "--photons", "1000", "--caustics", "--report", "report.json"});
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  const nlohmann::ordered_json asked = {
      {"texelSize", 0.5}, {"photons", 1000}, {"caustics", true}, {"sky", false}};
  EXPECT_EQ(report.at("options").at("lightMap"), asked);
}

TEST_F(CliLightMap, SameSeed_SameBytes) {
  bake("a.glb", {"--texel-size", "0.1"});
  bake("b.glb", {"--texel-size", "0.1"});
  EXPECT_EQ(readFile("a.lightmap.exr"), readFile("b.lightmap.exr"));
  const ProcessResult same = prelightDone({"compare", "a.glb", "b.glb"});
  EXPECT_THAT(same.output, HasSubstr("lightMap"));
  EXPECT_THAT(same.output, HasSubstr("rmse 0,"));
}

TEST_F(CliLightMap, Info_SaysWhatItWouldDoAndWhatAFileCarries) {
  EXPECT_THAT(prelightDone({"info", "scene.glb", "--lightmap", "--texel-size", "0.5"}).output,
              HasSubstr("texels of 0.5 m"));
  bake("out.glb", {"--texel-size", "0.1"});
  EXPECT_THAT(prelightDone({"info", "out.glb"}).output, HasSubstr("light map of"));
}

TEST_F(CliLightMap, LostPicture_IsABadInput) {
  bake("out.glb", {"--texel-size", "0.1"});
  std::filesystem::remove(path("out.lightmap.exr"));
  expectFailure(badInput, {"compare", "out.glb", "out.glb"},
                {"out.lightmap.exr", "no such file", "together"});
}

TEST_F(CliLightMap, BadOptions_AreUsageErrors) {
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--lightmap", "--texel-size", "0"},
                {"--texel-size"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--texel-size", "1"}, {"--lightmap"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--lightmap", "--texel-size", "1e-6"},
                {"--texel-size", "4096", "or more"});
}

TEST_F(CliLightMap, Caustics_BringALightMapWithThem) {
  prelightDone({"scene", "caustics", "-o", "scene.glb"});
  const auto report =
      nlohmann::json::parse(prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--caustics", "--photons",
                                          "5000", "--texel-size", "0.2", "--rays", "64", "--json"})
                                .output);
  std::size_t runs = 0;
  for (const nlohmann::json& pass : report["plan"]["passes"])
    for (const char* name : {"light map", "indirect light of the map", "caustics of the map"})
      runs += pass["name"] == name && pass["runs"].get<bool>();
  EXPECT_EQ(runs, 3u);
  EXPECT_GT(readFile("baked.lightmap.exr").size(), 1000u);
  expectFailure(2, {"bake", "scene.glb", "-o", "b.glb", "--ao", "--photons", "5000"},
                {"--photons", "--lightmap"});
}

}  // namespace
}  // namespace prelight::test
