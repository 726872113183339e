#include <gmock/gmock.h>

#include <cmath>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliChartTransfer : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "bumps", "-o", "bumps.glb"});
  }

  static const nlohmann::ordered_json& baked(const GlbScene& scene, std::size_t node) {
    return scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
  }
};

TEST_F(CliChartTransfer, Bumps_GetLightMapsInProportion) {
  const auto result = prelightDone({"bake", "bumps.glb", "-o", "out.glb", "--sh", "3", "--bounces", "1",
                                    "--texels", "48", "--rays", "32", "--report", "report.json"});
  const GlbScene scene = parseGlb(readFile("out.glb"));
  const auto& ground = baked(scene, 0).at("texels");
  EXPECT_EQ(ground.at("width"), 48);
  EXPECT_EQ(ground.at("channels"), 3);
  const std::vector<float> values = floatAccessor(scene, ground.at("coefficients"));
  EXPECT_EQ(values.size(), 48u * 48u * 27u);
  for (const float value : values) ASSERT_TRUE(std::isfinite(value));
  EXPECT_LT(baked(scene, 1).at("texels").at("width"), 48);
  const auto info = nlohmann::json::parse(prelightDone({"info", "out.glb", "--json"}).output);
  EXPECT_THAT(info.dump(), HasSubstr("\"largestSide\":48"));
  const auto report = nlohmann::json::parse(readFile("report.json"));
  EXPECT_EQ(report.at("options").at("texels"), 48);
  EXPECT_TRUE(report.at("stages").contains("texels"));
  EXPECT_THAT(report.at("plan").dump(), HasSubstr("normals of 2 normal-mapped materials"));
}

TEST_F(CliChartTransfer, MapsOfDifferentSurfacesOrSizes_AreNotCompared) {
  const auto bake = [this](const std::string& name, bool first, const std::string& size) {
    writeFile("scene.glb", floorAndRoofWithChart(first).bytes());
    prelightDone({"bake", "scene.glb", "-o", name, "--sh", "2", "--texels", size, "--rays", "16"});
  };
  bake("first.glb", true, "8");
  bake("second.glb", false, "8");
  bake("larger.glb", true, "12");
  EXPECT_THAT(prelightDone({"compare", "first.glb", "first.glb"}).output, HasSubstr("texels"));
  for (const char* other : {"second.glb", "larger.glb"}) {
    const ProcessResult result = prelightDone({"compare", "first.glb", other});
    EXPECT_THAT(result.errors, HasSubstr("in the second, so they are not compared")) << other;
    EXPECT_THAT(result.output, ::testing::Not(HasSubstr("texels"))) << other;
  }
}

TEST_F(CliChartTransfer, Picture_ShowsTheRelief) {
  prelightDone({"bake", "bumps.glb", "-o", "smooth.glb", "--sh", "3", "--rays", "64"});
  prelightDone({"bake", "bumps.glb", "-o", "relief.glb", "--sh", "3", "--rays", "64", "--texels", "128"});
  for (const char* name : {"smooth", "relief"})
    prelightDone({"render", std::string(name) + ".glb", "-o", std::string(name) + ".exr", "--shading", "sh",
                  "--size", "160x120"});
  const auto same =
      nlohmann::json::parse(prelightDone({"compare", "smooth.exr", "smooth.exr", "--json"}).output);
  const auto other =
      nlohmann::json::parse(prelightDone({"compare", "smooth.exr", "relief.exr", "--json"}).output);
  EXPECT_EQ(same.at("picture").at("rmse"), 0.0);
  EXPECT_GT(other.at("picture").at("rmse"), 0.02);
}

TEST_F(CliChartTransfer, WrongUse_IsExplained) {
  expectFailure(badUsage, {"bake", "bumps.glb", "-o", "x.glb", "--ao", "--texels", "16"},
                {"--texels", "--sh"});
  for (const char* size : {"0", "5000", "many"})
    expectFailure(badUsage, {"bake", "bumps.glb", "-o", "x.glb", "--sh", "2", "--texels", size},
                  {"--texels"});
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  expectFailure(badUsage,
                {"bake", "swing.glb", "-o", "x.glb", "--sh", "2", "--animation", "0", "--texels", "16"},
                {"--animation", "--texels"});
  expectFailure(badUsage,
                {"bake", "bumps.glb", "-o", "x.glb", "--sh", "8", "--bounces", "1", "--texels", "1024",
                 "--max-memory", "512M"},
                {"--texels", "--max-memory"});
}

TEST_F(CliChartTransfer, SceneWithoutCoordinates_GetsCharts) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  prelightDone({"bake", "cornell.glb", "-o", "x.glb", "--sh", "2", "--texels", "32", "--rays", "16"});
  const GlbScene scene = parseGlb(readFile("x.glb"));
  const auto& attributes = scene.json.at("meshes")[0].at("primitives")[0].at("attributes");
  ASSERT_TRUE(attributes.contains("TEXCOORD_1"));
  ASSERT_TRUE(attributes.contains("TEXCOORD_0"));
  const auto& texels = baked(scene, 0).at("texels");
  EXPECT_GT(texels.at("width"), 4);
  EXPECT_LE(texels.at("width"), 32);
}

}  // namespace
}  // namespace prelight::test
