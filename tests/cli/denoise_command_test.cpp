#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Denoises with a stand-in library that averages 3 x 3 pixels.
class CliDenoise : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  static ProcessOptions with(const char* library) {
    ProcessOptions options;
    options.environment = {{"PRELIGHT_OIDN_LIBRARY", library}};
    return options;
  }

  nlohmann::json run(const std::vector<std::string>& arguments) const {
    return nlohmann::json::parse(prelightDone(arguments, with(FAKE_OIDN)).output);
  }

  double difference(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output)["picture"]["rmse"];
  }
};

TEST_F(CliDenoise, Reference_IsFilteredAndSaysByWhat) {
  const std::vector<std::string> command{"reference", "scene.glb", "--size", "24x16",
                                         "--spp",     "4",         "--json", "-o"};
  const auto asked = [&](std::vector<std::string> more) {
    std::vector<std::string> all = command;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  EXPECT_FALSE(asked({"plain.exr"}).contains("denoiser"));
  const nlohmann::json report = asked({"clean.exr", "--denoise"});
  EXPECT_EQ(report["denoiser"]["name"], "Open Image Denoise 2.5.1");
  EXPECT_EQ(report["denoiser"]["file"], FAKE_OIDN);
  EXPECT_GT(report["stages"]["denoise"], 0.0);
  EXPECT_GT(difference("plain.exr", "clean.exr"), 1e-4);
  EXPECT_THAT(readFile("clean.exr"), HasSubstr("variance.Y"));
  asked({"again.exr", "--denoise"});
  EXPECT_EQ(readFile("clean.exr"), readFile("again.exr"));
}

TEST_F(CliDenoise, FullShading_IsFilteredAndSaysByWhat) {
  const std::vector<std::string> command{"render",       "scene.glb", "--shading", "full",      "--size",
                                         "24x16",        "--spp",     "2",         "--photons", "2000",
                                         "--map-texels", "512",       "-o"};
  std::vector<std::string> plain = command, clean = command;
  plain.emplace_back("plain.exr");
  clean.insert(clean.end(), {"clean.exr", "--denoise"});
  EXPECT_THAT(prelightDone(plain).output, Not(HasSubstr("denoised")));
  EXPECT_THAT(prelightDone(clean, with(FAKE_OIDN)).output, HasSubstr("Open Image Denoise 2.5.1"));
  EXPECT_GT(difference("plain.exr", "clean.exr"), 1e-4);
}

TEST_F(CliDenoise, LightMap_IsFilteredAndSaysByWhat) {
  const std::vector<std::string> command{"bake", "scene.glb", "--lightmap", "--texel-size",
                                         "0.1",  "--rays",    "64",         "-o"};
  std::vector<std::string> plain = command, clean = command;
  plain.emplace_back("plain.glb");
  clean.insert(clean.end(), {"clean.glb", "--denoise", "--report", "report.json"});
  prelightDone(plain);
  EXPECT_THAT(prelightDone(clean, with(FAKE_OIDN)).output, HasSubstr("charts, denoised"));
  const nlohmann::json report = nlohmann::json::parse(readFile("report.json"));
  EXPECT_TRUE(report["options"]["denoise"]);
  EXPECT_EQ(report["notes"][0], "light map denoised by Open Image Denoise 2.5.1");
  EXPECT_GT(difference("plain.lightmap.exr", "clean.lightmap.exr"), 1e-4);
}

TEST_F(CliDenoise, MissingLibrary_IsReportedBeforeAnythingIsMade) {
  const std::vector<std::string> said{"/nowhere/lib.so", "PRELIGHT_OIDN_LIBRARY", "pip install pyoidn"};
  expectFailure(failed, {"reference", "scene.glb", "-o", "a.exr", "--size", "8", "--denoise"}, said,
                with("/nowhere/lib.so"));
  expectFailure(failed,
                {"render", "scene.glb", "-o", "a.exr", "--size", "8", "--shading", "full", "--denoise"}, said,
                with("/nowhere/lib.so"));
  expectFailure(failed, {"bake", "scene.glb", "-o", "a.glb", "--lightmap", "--denoise"}, said,
                with("/nowhere/lib.so"));
}

TEST_F(CliDenoise, WhereNothingIsToDenoise_IsSaid) {
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "a.glb", "--ao", "--denoise"},
                {"--denoise", "--lightmap"});
  EXPECT_THAT(
      prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "8", "--shading", "phong", "--denoise"})
          .errors,
      HasSubstr("--denoise"));
}

}  // namespace
}  // namespace prelight::test
