#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

/// A floor under a roof with a point light.
class CliRadiosity : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  ProcessResult bake(const std::string& output, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "scene.glb", "-o", output, "--radiosity", "--rays", "128"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelightDone(arguments);
  }
};

TEST_F(CliRadiosity, Bake_WritesIrradianceAndReportsResiduals) {
  const ProcessResult result = bake("out.glb", {"--solver", "chebyshev", "--report", "report.json"});
  EXPECT_THAT(result.output, HasSubstr("iterations of chebyshev"));
  EXPECT_THAT(result.output, ::testing::Not(HasSubstr("AO 0.0")));
  const GlbScene scene = parseGlb(readFile("out.glb"));
  for (std::size_t node = 0; node < 2; ++node) {
    const auto& entry =
        scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
    EXPECT_EQ(entry.size(), 1u);
    const auto& accessor = scene.json.at("accessors").at(entry.at("irradiance").get<std::size_t>());
    EXPECT_EQ(accessor.at("type"), "VEC3");
    for (const float value : floatAccessor(scene, entry.at("irradiance"))) EXPECT_GE(value, 0.0f);
  }
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  EXPECT_EQ(report.at("radiosity").at("converged"), true);
  EXPECT_EQ(report.at("radiosity").at("solver"), "chebyshev");
  EXPECT_GT(report.at("radiosity").at("residuals").size(), 1u);
  EXPECT_LT(report.at("radiosity").at("residual"), 1e-4);
  EXPECT_EQ(report.at("options").at("radiosity"), true);
  EXPECT_EQ(report.at("options").at("sky"), false);
}

TEST_F(CliRadiosity, SameSeed_SameBytesWhateverTheSolverOrder) {
  bake("a.glb", {"--seed", "3"});
  bake("b.glb", {"--seed", "3"});
  const auto irradiance = [&](const std::string& name) {
    const GlbScene scene = parseGlb(readFile(name));
    const auto& entry =
        scene.json.at("nodes").at(0).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
    return floatAccessor(scene, entry.at("irradiance"));
  };
  EXPECT_EQ(irradiance("a.glb"), irradiance("b.glb"));
  const ProcessResult result = prelightDone({"compare", "a.glb", "b.glb"});
  EXPECT_THAT(result.output, HasSubstr("irradiance"));
}

TEST_F(CliRadiosity, Info_SaysWhatItWouldDoAndWhatAFileCarries) {
  EXPECT_THAT(prelightDone({"info", "scene.glb", "--radiosity", "--patch-size", "0.5"}).output,
              HasSubstr("elements of at most 0.5 m"));
  bake("out.glb", {});
  EXPECT_THAT(prelightDone({"info", "out.glb"}).output, HasSubstr("irradiance of static lights"));
}

TEST_F(CliRadiosity, BadOptions_AreUsageErrors) {
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--radiosity", "--solver", "gauss"},
                {"--solver", "gauss-seidel"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--radiosity", "--tolerance", "2"},
                {"--tolerance"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--radiosity", "--patch-size", "1e-5"},
                {"--patch-size", "larger patches"});
}

}  // namespace
}  // namespace prelight::test
