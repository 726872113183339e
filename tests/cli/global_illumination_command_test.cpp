#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"
#include "support/installed_programs.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliGlobalIllumination : public CliTest {
 protected:
  nlohmann::json render(std::vector<std::string> arguments, const char* photons = "2000") const {
    arguments.insert(arguments.begin(), "render");
    for (const char* more : {"--shading", "full", "--size", "24x24", "--spp", "4", "--photons", photons,
                             "--map-texels", "512", "--json"})
      arguments.emplace_back(more);
    return nlohmann::json::parse(prelightDone(arguments).output);
  }

  nlohmann::json compare(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output);
  }
};

nlohmann::json passOf(const nlohmann::json& report, const std::string& name) {
  for (const nlohmann::json& pass : report["plan"])
    if (pass["name"] == name) return pass;
  return {};
}

TEST_F(CliGlobalIllumination, DiffuseScene_SkipsCausticsAndSaysWhy) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  const nlohmann::json report = render({"cornell.glb", "-o", "a.exr"});
  EXPECT_EQ(report["shading"], "full");
  EXPECT_GT(report["photons"]["stored"], 1000);
  EXPECT_EQ(report["causticPhotons"]["rays"], 0);
  EXPECT_FALSE(passOf(report, "caustic photons")["runs"]);
  EXPECT_THAT(passOf(report, "caustic photons")["reason"].get<std::string>(),
              HasSubstr("no surface is a mirror"));
  EXPECT_GT(compare("a.exr", "a.exr")["picture"]["meanA"], 0.05);
}

TEST_F(CliGlobalIllumination, Summary_NamesThePassesThatAreSkippedAndNoOthers) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  const nlohmann::json report = render({"cornell.glb", "-o", "a.exr"});
  const std::string messages =
      prelightDone({"render", "cornell.glb", "-o", "a.exr", "--shading", "full", "--size", "24x24", "--spp",
                    "4", "--photons", "2000", "--map-texels", "512"})
          .output;
  std::size_t skipped = 0;
  for (const nlohmann::json& pass : report["plan"]) {
    const std::string line = pass["name"].get<std::string>() + ": " + pass["reason"].get<std::string>();
    EXPECT_EQ(messages.find(line) == std::string::npos, pass["runs"].get<bool>()) << line;
    skipped += pass["runs"] ? 0 : 1;
  }
  EXPECT_GT(skipped, 0u);
  EXPECT_LT(skipped, report["plan"].size());
}

TEST_F(CliGlobalIllumination, SameSeed_GivesTheSameBytesAndAnotherSeedDoesNot) {
  prelightDone({"scene", "caustics", "-o", "scene.glb"});
  EXPECT_TRUE(
      passOf(render({"scene.glb", "-o", "a.exr", "--caustic-photons", "5000"}), "caustic photons")["runs"]);
  render({"scene.glb", "-o", "b.exr", "--caustic-photons", "5000"});
  render({"scene.glb", "-o", "c.exr", "--caustic-photons", "5000", "--seed", "1"});
  EXPECT_EQ(compare("a.exr", "b.exr")["picture"]["max"], 0.0);
  EXPECT_GT(compare("a.exr", "c.exr")["picture"]["max"], 0.0);
}

TEST_F(CliGlobalIllumination, Gatherers_DifferInRaysAndAgreeInLight) {
  prelightDone({"scene", "cornell", "-o", "scene.glb"});
  const nlohmann::json all = render({"scene.glb", "-o", "all.exr"});
  EXPECT_EQ(all["gather"], "all");
  EXPECT_EQ(all["gatheredAt"], all["texels"]);
  const nlohmann::json few = render({"scene.glb", "-o", "few.exr", "--gather-rays", "16"});
  EXPECT_LT(few["rays"], all["rays"]);
  for (const std::string choice : {"cache", "guided"}) {
    const nlohmann::json report = render({"scene.glb", "-o", "b.exr", "--gather", choice});
    EXPECT_EQ(report["gather"], choice);
    EXPECT_EQ(report["gatheredAt"] < report["texels"], choice == "cache");
    const nlohmann::json picture = compare("all.exr", "b.exr")["picture"];
    EXPECT_GT(picture["max"], 0.0) << choice;
    EXPECT_NEAR(picture["meanB"].get<double>() / picture["meanA"].get<double>(), 1.0, 0.01) << choice;
  }
}

TEST_F(CliGlobalIllumination, PhotonsByImportance_AreOthersAndBringTheSameLight) {
  prelightDone({"scene", "rooms", "-o", "scene.glb"});
  for (const std::string choice : {"power", "importance"}) {
    const ProcessResult result = prelightDone({"render", "scene.glb", "-o", choice + ".exr", "--shading",
                                               "full", "--size", "24x24", "--spp", "4", "--photons", "100000",
                                               "--map-texels", "512", "--photons-by", choice, "--json"});
    EXPECT_EQ(nlohmann::json::parse(result.output)["photonsBy"], choice);
  }
  const nlohmann::json picture = compare("power.exr", "importance.exr")["picture"];
  EXPECT_GT(picture["max"], 0.0);
  EXPECT_NEAR(picture["meanB"].get<double>() / picture["meanA"].get<double>(), 1.0, 0.03);
}

TEST_F(CliGlobalIllumination, SceneWithoutLight_IsLitByANeutralSky) {
  writeFile("scene.glb", floorAndRoof().bytes());
  const ProcessResult result = prelightDone(
      {"render", "scene.glb", "-o", "a.exr", "--shading", "full", "--size", "16x16", "--light", "none"});
  EXPECT_THAT(result.errors, HasSubstr("lit by a neutral sky"));
  EXPECT_GT(compare("a.exr", "a.exr")["picture"]["meanA"], 0.0);
}

TEST_F(CliGlobalIllumination, OptionsOutOfRange_AreRefusedBeforeAnythingIsWritten) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--spp", "0"},
                                                        {"--spp", "65"},
                                                        {"--photons", "0"},
                                                        {"--map-texels", "many"},
                                                        {"--gather", "none"},
                                                        {"--photons-by", "none"},
                                                        {"--gather-rays", "100"},
                                                        {"--caustic-photons", "-1"}}) {
    expectFailure(2, {"render", "cornell.glb", "-o", "a.exr", "--shading", "full", option, value}, {option});
  }
}

TEST_F(CliGlobalIllumination, Rasterised_IsCloseToTheTracedPictureAndHasTheSamePlan) {
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  render({"shapes.glb", "-o", "a.exr"}, "20000");
  const nlohmann::json drawn = render({"shapes.glb", "-o", "b.exr", "--rasterised"}, "20000");
  EXPECT_EQ(drawn["shading"], "full");
  EXPECT_FALSE(passOf(drawn, "caustic photons")["runs"]);
  const nlohmann::json picture = compare("a.exr", "b.exr")["picture"];
  EXPECT_NEAR(picture["meanB"].get<double>() / picture["meanA"].get<double>(), 1.0, 0.02);
}

TEST_F(CliGlobalIllumination, Window_ShowsWhatIsDrawnWithoutOne) {
  SKIP_WITHOUT("xvfb-run");
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  const std::vector<std::string> same = {"--shading", "full", "--size",       "48x48",
                                         "--photons", "2000", "--map-texels", "512"};
  std::vector<std::string> drawn = {"render", "shapes.glb", "-o", "a.exr", "--rasterised", "--spp", "4"};
  drawn.insert(drawn.end(), same.begin(), same.end());
  prelightDone(drawn);
  std::vector<std::string> window = {
      "xvfb-run",   "-a",       "-s", "-screen 0 640x480x24", PRELIGHT_PROGRAM, "view",
      "shapes.glb", "--frames", "3",  "--screenshot",         "b.exr"};
  window.insert(window.end(), same.begin(), same.end());
  const ProcessResult view = runProcess(window, {.directory = path("")});
  ASSERT_EQ(view.exitCode, 0) << view.errors;
  const nlohmann::json picture = compare("a.exr", "b.exr")["picture"];
  EXPECT_GT(picture["meanA"].get<double>(), 0.05);
  EXPECT_LT(picture["rmse"].get<double>(), 1e-5);
}

TEST_F(CliGlobalIllumination, RasterisedWithAnotherShading_IsRefused) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  expectFailure(2, {"render", "cornell.glb", "-o", "a.exr", "--shading", "phong", "--rasterised"},
                {"--rasterised", "--shading full"});
}

}  // namespace
}  // namespace prelight::test
