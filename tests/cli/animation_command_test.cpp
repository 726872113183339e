#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"
#include "support/installed_programs.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The built-in animated scene, which lasts 4 s.
class CliAnimation : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "swing", "-o", "swing.glb"});
  }

  ProcessResult bake(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "swing.glb", "-o", "baked.glb", "--sh", "2", "--rays", "4"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelightDone(arguments);
  }

  ProcessResult render(const std::string& scene, const std::string& output,
                       const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {
        "render", scene,       "-o", output,    "--size",
        "96x72",  "--shading", "sh", "--light", "directional:0.3,-1,-0.5:2,2,2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelightDone(arguments);
  }

  /// Returns what the baked file has of its first primitive.
  nlohmann::ordered_json baked() const {
    const GlbScene file = parseGlb(readFile("baked.glb"));
    return file.json.at("nodes").at(0).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
  }

  double difference(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output)["picture"]["rmse"];
  }
};

TEST_F(CliAnimation, Bake_StoresAKeyForEachMomentBesideTheRestPose) {
  bake({"--animation", "swing", "--keys", "3"});
  const GlbScene baked = parseGlb(readFile("baked.glb"));
  const auto& root = baked.json.at("extensions").at("PRELIGHT_transfer");
  EXPECT_EQ(root.at("animation").at("index"), 0);
  EXPECT_EQ(root.at("animation").at("times"), (nlohmann::ordered_json{0.0, 2.0, 4.0}));
  for (std::size_t node = 0; node < 5; ++node) {
    const auto& entry =
        baked.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
    EXPECT_TRUE(entry.contains("sh")) << "the rest pose, for readers that know nothing of keys";
    EXPECT_EQ(entry.at("keys").size(), 3u);
  }
  const nlohmann::json info = nlohmann::json::parse(prelightDone({"info", "baked.glb", "--json"}).output);
  EXPECT_EQ(info["contents"]["animations"][0]["end"], 4.0);
  EXPECT_EQ(info["baked"]["animation"]["times"].size(), 3u);
}

TEST_F(CliAnimation, CompressedPicture_OfAFileWithKeysAndNearLamps_IsDrawn) {
  bake({"--near-lamps", "4", "--animation", "swing", "--keys", "2"});
  ASSERT_TRUE(baked().at("nearLamps").contains("keys"));
  prelightDone({"render", "baked.glb", "-o", "small.png", "--shading", "horizons", "--compress", "auto",
                "--size", "16x16", "--rays", "4"});
}

TEST_F(CliAnimation, BakeWithoutAnimation_TakesTheRestPoseAndSaysSo) {
  EXPECT_THAT(bake({}).errors, HasSubstr("--animation"));
  EXPECT_THAT(readFile("baked.glb"), Not(HasSubstr("\"keys\"")));
}

TEST_F(CliAnimation, KeyError_OfALooseBoundNeedsFewKeysAndKeepsIt) {
  const std::string report = bake({"--animation", "0", "--key-error", "0.5"}).output;
  EXPECT_THAT(report, HasSubstr("error"));
  const auto root = parseGlb(readFile("baked.glb")).json.at("extensions").at("PRELIGHT_transfer");
  EXPECT_EQ(root.at("animation").at("times").front(), 0.0);
  EXPECT_EQ(root.at("animation").at("times").back(), 4.0);
}

TEST_F(CliAnimation, RenderAtAKey_IsThePictureOfABakeAtThatMoment) {
  bake({"--animation", "0", "--keys", "3"});
  EXPECT_THAT(render("baked.glb", "keys.exr", {"--at", "2"}).errors, Not(HasSubstr("left out")))
      << "the keys are what is shown";
  render("swing.glb", "there.exr", {"--at", "2", "--sh", "2", "--rays", "4"});
  EXPECT_LT(difference("keys.exr", "there.exr"), 1e-6);
  render("baked.glb", "rest.exr", {});
  EXPECT_GT(difference("keys.exr", "rest.exr"), 0.01) << "nothing has moved";
}

TEST_F(CliAnimation, RenderBetweenKeys_IsNearABakeAtThatMoment) {
  bake({"--animation", "0", "--keys", "5"});
  render("baked.glb", "keys.exr", {"--at", "1.4", "--animation", "swing"});
  render("baked.glb", "wrong.exr", {"--at", "1"});
  render("swing.glb", "there.exr", {"--at", "1.4", "--sh", "2", "--rays", "4"});
  EXPECT_LT(difference("keys.exr", "there.exr"), 0.5 * difference("wrong.exr", "there.exr"));
}

TEST_F(CliAnimation, RenderedFrames_AreThePicturesAtTheirMoments) {
  bake({"--animation", "0", "--keys", "3"});
  render("baked.glb", "frame.%02d.exr", {"--fps", "2", "--at", "2.5"});
  for (const auto& [frame, seconds] :
       std::vector<std::pair<std::string, std::string>>{{"00", "2.5"}, {"01", "3"}, {"03", "4"}}) {
    render("baked.glb", "still.exr", {"--at", seconds});
    EXPECT_EQ(difference("frame." + frame + ".exr", "still.exr"), 0.0) << seconds << " s";
  }
  EXPECT_GT(difference("frame.00.exr", "frame.03.exr"), 0.001) << "nothing has moved";
  EXPECT_EQ(files().count("frame.04.exr"), 0u);
}

TEST_F(CliAnimation, FullFrames_AreThePicturesAtTheirMoments) {
  const auto full = [&](const std::string& output, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {
        "render", "swing.glb", "-o",   output,   "--shading", "full",         "--spp",
        "1",      "--photons", "2000", "--size", "96x72",     "--map-texels", "500"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    prelightDone(arguments);
  };
  full("frame.%d.exr", {"--fps", "1", "--at", "2.5"});
  for (const auto& [frame, seconds] :
       std::vector<std::pair<std::string, std::string>>{{"0", "2.5"}, {"1", "3.5"}}) {
    full("still.exr", {"--at", seconds});
    EXPECT_EQ(difference("frame." + frame + ".exr", "still.exr"), 0.0) << seconds << " s";
  }
  EXPECT_GT(difference("frame.0.exr", "frame.1.exr"), 0.001) << "nothing has moved";
  EXPECT_EQ(files().count("frame.2.exr"), 0u);
}

TEST_F(CliAnimation, PlayedWindow_ShowsTheMomentOfItsLastFrame) {
  SKIP_WITHOUT("xvfb-run");
  bake({"--animation", "0", "--keys", "3"});
  std::vector<std::string> command = {"xvfb-run",
                                      "-a",
                                      "-s",
                                      "-screen 0 640x480x24",
                                      PRELIGHT_PROGRAM,
                                      "view",
                                      "baked.glb",
                                      "--play",
                                      "--animation",
                                      "swing",
                                      "--speed",
                                      "-2",
                                      "--at",
                                      "2.5",
                                      "--frames",
                                      "31",
                                      "--size",
                                      "96x72",
                                      "--shading",
                                      "sh",
                                      "--light",
                                      "directional:0.3,-1,-0.5:2,2,2",
                                      "--screenshot",
                                      "shot.exr"};
  const ProcessResult view = runProcess(command, {.directory = path("")});
  ASSERT_EQ(view.exitCode, 0) << view.errors;
  render("baked.glb", "still.exr", {"--at", "1.5"});
  EXPECT_LT(difference("shot.exr", "still.exr"), 1e-6);
}

TEST_F(CliAnimation, BadOptions_AreUsageErrors) {
  const std::vector<std::string> start = {"bake", "swing.glb", "-o", "b.glb"};
  const auto refused = [&](std::vector<std::string> options, const std::vector<std::string>& parts) {
    options.insert(options.begin(), start.begin(), start.end());
    expectFailure(2, options, parts);
  };
  refused({"--sh", "2", "--animation", "jump"}, {"jump", "0 \"swing\""});
  refused({"--sh", "2", "--animation", "1"}, {"1", "swing"});
  refused({"--ao", "--animation", "0"}, {"--animation", "--sh"});
  refused({"--sh", "2", "--keys", "3"}, {"--keys", "--animation"});
  refused({"--sh", "2", "--key-error", "0.1"}, {"--key-error", "--animation"});
  refused({"--sh", "2", "--animation", "0", "--keys", "0"}, {"--keys", "1"});
  refused({"--sh", "2", "--animation", "0", "--key-error", "0"}, {"--key-error"});
  refused({"--sh", "2", "--animation", "0", "--keys", "3", "--key-error", "0.1"}, {"--key"});
  expectFailure(2, {"render", "swing.glb", "-o", "a.png", "--animation", "0"}, {"--animation", "--at"});
  expectFailure(2, {"render", "swing.glb", "-o", "a.png", "--at", "-1"}, {"--at"});
  expectFailure(2, {"render", "swing.glb", "-o", "a.png", "--fps", "2", "--shading", "phong"},
                {"-o a.png", "%04d"});
  expectFailure(2, {"render", "swing.glb", "-o", "a%d.png", "--fps", "2", "--caustics", "100"},
                {"--fps --caustics", "full"});
  expectFailure(2,
                {"render", "swing.glb", "-o", "a%d.png", "--fps", "2", "--shading", "full", "--rasterised"},
                {"--fps --rasterised", "traced"});
  expectFailure(2, {"view", "swing.glb", "--play", "--caustics", "100"}, {"--play --caustics"});
  expectFailure(2, {"view", "swing.glb", "--play", "--speed", "99"}, {"--speed"});
  writeFile("still.glb", floorAndRoof().bytes());
  expectFailure(2, {"render", "still.glb", "-o", "a%d.png", "--fps", "2", "--shading", "phong"},
                {"--fps", "no animations"});
  expectFailure(2, {"render", "still.glb", "-o", "a.png", "--at", "1"}, {"no animations"});
}

}  // namespace
}  // namespace prelight::test
