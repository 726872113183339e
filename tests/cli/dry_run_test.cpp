#include <gmock/gmock.h>

#include <cmath>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliDryRun : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }
};

TEST_F(CliDryRun, Bake_TellsPlanSizeAndTimeAndWritesNothing) {
  const std::string text =
      prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--sh", "4", "--dry-run"}).output;
  for (const char* part : {"would bake --sh 4", "runs       cast", "skipped    haar transfer: not asked for",
                           "would write baked.glb: about", "time       about"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(files(), std::set<std::string>{"scene.glb"});
}

TEST_F(CliDryRun, Sizes_AreThoseOfTheFileThatIsWritten) {
  const std::vector<std::vector<std::string>> requests = {
      {"--ao", "--sh", "3", "--rays", "64"},
      {"--sh", "4", "--rays", "64", "--compress", "half"},
      {"--lightmap", "--texel-size", "0.1", "--rays", "64", "--photons", "1000"}};
  for (const std::vector<std::string>& request : requests) {
    std::vector<std::string> command = {"bake", "scene.glb", "-o", "baked.glb"};
    command.insert(command.end(), request.begin(), request.end());
    prelightDone(command);
    const double written = static_cast<double>(std::filesystem::file_size(path("baked.glb")));
    command.insert(command.end(), {"--dry-run", "--json"});
    const auto report = nlohmann::json::parse(prelightDone(command).output);
    EXPECT_EQ(report["dryRun"], true);
    // The digits of the seconds vary.
    EXPECT_NEAR(report["outputBytes"].get<double>(), written, 256.0) << request[0];
    EXPECT_GT(report["estimatedSeconds"].get<double>(), 0.0);
  }
}

TEST_F(CliDryRun, Time_ThatIsAskedForOrCannotBeKnown_IsSaidSo) {
  const std::vector<std::string> bake = {"bake", "scene.glb", "-o", "baked.glb", "--ao", "--dry-run"};
  std::vector<std::string> byError = bake, byTime = bake;
  byError.insert(byError.end(), {"--error", "0.01", "--json"});
  byTime.insert(byTime.end(), {"--time", "7"});
  EXPECT_TRUE(nlohmann::json::parse(prelightDone(byError).output)["estimatedSeconds"].is_null());
  EXPECT_THAT(prelightDone(byTime).output, HasSubstr("as asked for"));
}

TEST_F(CliDryRun, BakeWithAnExport_MakesNoFolder) {
  prelightDone(
      {"bake", "scene.glb", "-o", "baked.glb", "--ao", "--rays", "16", "--export", "out", "--dry-run"});
  EXPECT_EQ(files(), std::set<std::string>{"scene.glb"});
}

TEST_F(CliDryRun, Export_TellsTheFilesAndTheirSizes) {
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--lightmap", "--texel-size", "0.2", "--rays", "16",
                "--photons", "1000"});
  const std::set<std::string> before = files();
  for (const std::string target : {"gltf", "unity"}) {
    const std::vector<std::string> command = {"export",   "baked.glb", "-o",    "out",
                                              "--target", target,      "--json"};
    std::vector<std::string> dry = command;
    dry.emplace_back("--dry-run");
    const auto planned = nlohmann::json::parse(prelightDone(dry).output);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(planned["dryRun"], true);
    const auto written = nlohmann::json::parse(prelightDone(command).output);
    EXPECT_EQ(planned["files"], written["files"]);
    for (const auto& file : written["files"])
      EXPECT_EQ(file["bytes"], std::filesystem::file_size(path("out") / file["name"].get<std::string>()));
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(CliDryRun, Reference_TellsSizeAndTimeAndWritesNothing) {
  const std::vector<std::string> command = {"reference", "scene.glb", "-o",    "truth.exr",
                                            "--size",    "48x32",     "--spp", "64"};
  std::vector<std::string> dry = command;
  dry.insert(dry.end(), {"--dry-run", "--json"});
  const auto planned = nlohmann::json::parse(prelightDone(dry).output);
  EXPECT_EQ(files(), std::set<std::string>{"scene.glb"});
  EXPECT_EQ(planned["width"], 48);
  EXPECT_GT(planned["estimatedSeconds"].get<double>(), 0.0);
  EXPECT_GT(planned["plan"].size(), 3u);
  prelightDone(command);
  const double written = static_cast<double>(std::filesystem::file_size(path("truth.exr")));
  EXPECT_NEAR(planned["outputBytes"].get<double>(), written, 0.2 * written);
  dry.insert(dry.end() - 2, {"--resume"});
  expectFailure(badUsage, dry, {"--resume"});
}

TEST_F(CliDryRun, FullShading_TellsSizeAndTimeAndWritesNothing) {
  const std::string text = prelightDone({"render", "scene.glb", "-o", "full.png", "--shading", "full",
                                         "--size", "96x64", "--photons", "20000", "--dry-run"})
                               .output;
  for (const char* part :
       {"would draw 96x64, full shading", "would write full.png: about", "time       about", "skipped    "})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(files(), std::set<std::string>{"scene.glb"});
  expectFailure(badUsage, {"render", "scene.glb", "-o", "ao.png", "--shading", "ao", "--dry-run"},
                {"--dry-run"});
}

TEST_F(CliDryRun, OutputThatCannotBeWritten_IsFoundOut) {
  expectFailure(failed, {"bake", "scene.glb", "-o", "nowhere/baked.glb", "--dry-run"}, {"nowhere"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "baked.glb", "--dry-run", "--resume"}, {"--resume"});
}

}  // namespace
}  // namespace prelight::test
