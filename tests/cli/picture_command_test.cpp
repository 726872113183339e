#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"
#include "support/installed_programs.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliPicture : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  nlohmann::json compare(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output);
  }
};

TEST_F(CliPicture, Render_OfAPlainScene_NeedsNoBake) {
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "a.png", "--size", "48x32"});
  EXPECT_THAT(result.errors, Not(HasSubstr("baking")));
  EXPECT_EQ(readFile("a.png").substr(1, 3), "PNG");
}

TEST_F(CliPicture, PlainScene_IsDrawnInFullShading) {
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "48x32"});
  EXPECT_THAT(result.output, HasSubstr("full shading"));
}

TEST_F(CliPicture, PlainSceneWithoutADevice_IsDrawnInPhongAndSaysSo) {
  const ProcessOptions bare{.environment = {{"OCL_ICD_VENDORS", "/nonexistent-dir"}}};
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "a.png", "--size", "48x32"}, bare);
  EXPECT_THAT(result.output, HasSubstr("phong shading"));
  EXPECT_THAT(result.errors, HasSubstr("direct light alone is drawn"));
}

TEST_F(CliPicture, Render_OfWhatTheFileLacks_BakesItAndSaysSo) {
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "48x32",
                                             "--shading", "sh", "--sh", "2", "--rays", "16"});
  EXPECT_THAT(result.errors, HasSubstr("baking --sh 2 now"));
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--sh", "2", "--rays", "16"});
  prelightDone({"render", "baked.glb", "-o", "b.exr", "--size", "48x32", "--shading", "sh"});
  EXPECT_LT(compare("a.exr", "b.exr")["picture"]["max"], 1e-6);
}

TEST_F(CliPicture, Render_InEveryShading_BakesWhatItNeeds) {
  const std::vector<std::pair<std::string, std::string>> needs = {
      {"ao", "--ao"},        {"sh", "--sh 3 --bounces 1"},         {"ch", "--ch 3 --bounces 1"},
      {"haar", "--haar 32"}, {"glossy", "--glossy 4 --bounces 1"}, {"lights", "--light-groups"},
  };
  for (const auto& [shading, baked] : needs) {
    const ProcessResult result = prelightDone({"render", "scene.glb", "-o", shading + ".exr", "--size",
                                               "24x16", "--shading", shading, "--rays", "16"});
    EXPECT_THAT(result.errors, HasSubstr("baking " + baked)) << shading;
    EXPECT_GT(compare(shading + ".exr", shading + ".exr")["picture"]["meanA"], 0.0) << shading;
  }
}

TEST_F(CliPicture, SmallAreaLight_IsTracedAsAPointLightOfItsPower) {
  const auto trace = [&](const std::string& picture, const std::string& light) {
    prelightDone({"reference", "scene.glb", "-o", picture, "--size", "24x16", "--integrator", "whitted",
                  "--spp", "1024", "--light", light});
  };
  trace("area.exr", "area:sphere:0,3,4:0.05:3183.1,1273.24,636.62");  // pi r^2 = 1 / 127.324.
  trace("point.exr", "point:0,3,4:25,10,5");
  const nlohmann::json traced = compare("area.exr", "point.exr")["picture"];
  EXPECT_GT(traced["meanB"], 0.01);
  EXPECT_NEAR(traced["meanA"].get<double>() / traced["meanB"].get<double>(), 1.0, 0.01);
}

TEST_F(CliPicture, AreaLight_WhereItCannotShine_IsRefused) {
  const ProcessResult result = prelight({"render", "scene.glb", "-o", "a.exr", "--size", "24x16", "--shading",
                                         "radiosity", "--light", "area:sphere:0,1,0:0.1:5,5,5"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.errors, HasSubstr("its bake cannot use area lights and cookies"));
}

TEST_F(CliPicture, ScreenShading_NeedsNoBakeAndDiffersByItsOptions) {
  const auto render = [&](const std::string& picture, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "scene.glb", "-o", picture, "--size", "48x32", "--shading",
                                     "screen", "--env", "neutral", "--light", "none"});
    return options;
  };
  const ProcessResult wide = prelightDone(render("a.exr", {"--occlusion-radius", "2"}));
  EXPECT_THAT(wide.errors, Not(HasSubstr("baking")));
  prelightDone(render("b.exr", {"--occlusion-radius", "0.001"}));
  prelightDone(render("c.exr", {"--occlusion", "hbao", "--occlusion-radius", "2"}));
  prelightDone(
      render("d.exr", {"--occlusion", "disks", "--occlusion-radius", "2", "--occlusion-passes", "2"}));
  prelightDone(render("f.exr", {"--occlusion", "fields", "--occlusion-radius", "2", "--occlusion-cells",
                                "512", "--occlusion-rays", "20"}));
  EXPECT_LT(compare("f.exr", "b.exr")["picture"]["meanA"], compare("f.exr", "b.exr")["picture"]["meanB"]);
  EXPECT_LT(compare("d.exr", "b.exr")["picture"]["meanA"], compare("d.exr", "b.exr")["picture"]["meanB"]);
  EXPECT_LT(compare("a.exr", "b.exr")["picture"]["meanA"], compare("a.exr", "b.exr")["picture"]["meanB"]);
  EXPECT_GT(compare("a.exr", "c.exr")["picture"]["max"], 1e-3);
  expectFailure(2, render("d.exr", {"--occlusion", "ao"}), {"--occlusion: got 'ao'", "ssao or hbao or gtao"});
  expectFailure(2, render("d.exr", {"--occlusion-slices", "0"}), {"--occlusion-slices", "1", "64"});
  expectFailure(2, render("d.exr", {"--occlusion-radius", "-1"}), {"--occlusion-radius"});
  const ProcessResult other = prelightDone(
      {"render", "scene.glb", "-o", "e.exr", "--size", "24x16", "--shading", "phong", "--occlusion", "ssao"});
  EXPECT_THAT(other.errors, HasSubstr("applies to screen shading"));
}

TEST_F(CliPicture, InstantShading_NeedsNoBakeAndDiffersByItsOptions) {
  prelightDone({"scene", "cornell", "-o", "room.glb"});
  const auto render = [&](const std::string& picture, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"render", "room.glb", "-o", picture, "--size", "24x16", "--shading", "instant"});
    return options;
  };
  const ProcessResult result = prelightDone(render("a.exr", {"--virtual-lights", "8"}));
  EXPECT_THAT(result.errors, Not(HasSubstr("baking")));
  prelightDone(render("b.exr", {"--virtual-lights", "8", "--virtual-nearest", "1000000"}));
  EXPECT_GT(compare("a.exr", "b.exr")["picture"]["meanA"], compare("a.exr", "b.exr")["picture"]["meanB"]);
  expectFailure(2, render("c.exr", {"--virtual-lights", "0"}), {"--virtual-lights", "1", "1024"});
  const ProcessResult other = prelightDone({"render", "scene.glb", "-o", "c.exr", "--size", "24x16",
                                            "--shading", "phong", "--virtual-lights", "8"});
  EXPECT_THAT(other.errors, HasSubstr("applies to instant shading"));
}

/// The picture is the same whether the encoding is baked on the way or was baked before. A file that lacks
/// the encoding is not baked anew unasked.
TEST_F(CliPicture, Encoding_IsBakedOrReadOrMissed) {
  const std::vector<std::string> size = {"--size", "48x32", "--rays", "16", "--texel-size", "0.2"};
  const auto render = [&](const std::string& scene, const std::string& picture,
                          std::vector<std::string> options) {
    options.insert(options.end(), size.begin(), size.end());
    options.insert(options.begin(), {"render", scene, "-o", picture});
    return options;
  };
  const ProcessResult result = prelightDone(render("scene.glb", "a.exr", {"--encoding", "ambient-cube"}));
  EXPECT_THAT(result.errors, HasSubstr("baking --lightmap --texel-size 0.2 --encode ambient-cube"));
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--lightmap", "--rays", "16", "--texel-size", "0.2",
                "--encode", "ambient-cube"});
  for (const char* shading : {"lightmap", "radiosity"}) {
    const ProcessResult read =
        prelightDone(render("baked.glb", "b.exr", {"--shading", shading, "--encoding", "ambient-cube"}));
    EXPECT_THAT(read.errors, Not(HasSubstr("baking")));
    EXPECT_GT(compare("b.exr", "b.exr")["picture"]["meanA"], 0.0);
    if (std::string(shading) == "lightmap") {
      EXPECT_LT(compare("a.exr", "b.exr")["picture"]["max"], 1e-5);
    }
    expectFailure(3, render("baked.glb", "c.exr", {"--shading", shading, "--encoding", "sh-3"}),
                  {"baked.glb", "not stored as sh-3, but as ambient-cube", "--encode sh-3"});
  }
  prelightDone({"bake", "scene.glb", "-o", "plain.glb", "--lightmap", "--rays", "16", "--texel-size", "0.2"});
  expectFailure(3, render("plain.glb", "c.exr", {"--encoding", "sh-3"}), {"nor in any other encoding"});
  expectFailure(2, render("scene.glb", "c.exr", {"--encoding", "sh"}), {"--encoding sh", "sh-3", "one of"});
  expectFailure(2, render("scene.glb", "c.exr", {"--shading", "sh", "--encoding", "sh-3"}),
                {"--encoding", "sh shading", "--shading lightmap"});
}

TEST_F(CliPicture, Ch_OfTheSameBake_ShowsWhatShShows) {
  prelightDone(
      {"bake", "scene.glb", "-o", "baked.glb", "--sh", "5", "--ch", "5", "--bounces", "1", "--rays", "64"});
  const std::vector<std::string> size = {"--size", "48x32", "--light", "point:0,9,0:40,30,20"};
  for (const char* shading : {"sh", "ch"}) {
    std::vector<std::string> arguments = {"render",    "baked.glb", "-o", std::string(shading) + ".exr",
                                          "--shading", shading};
    arguments.insert(arguments.end(), size.begin(), size.end());
    prelightDone(arguments);
  }
  const nlohmann::json difference = compare("ch.exr", "sh.exr");
  EXPECT_LT(difference["picture"]["max"].get<double>(), 2e-5 * difference["picture"]["meanB"].get<double>());
}

TEST_F(CliPicture, CompressedFile_IsDrawnByDefault) {
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--sh", "3", "--rays", "64", "--compress", "half"});
  prelightDone({"bake", "scene.glb", "-o", "full.glb", "--sh", "3", "--rays", "64"});
  const ProcessResult result = prelightDone({"render", "baked.glb", "-o", "a.exr", "--size", "48x32"});
  EXPECT_THAT(result.output, HasSubstr("sh shading"));
  prelightDone({"render", "full.glb", "-o", "b.exr", "--size", "48x32"});
  // Of 20 W/sr at 1 m, which the roof hides.
  EXPECT_LT(compare("a.exr", "b.exr")["picture"]["max"], 2e-3 * 20.0 / 3.14159);
}

TEST_F(CliPicture, LightGroup_Scaled_ScalesThePicture) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  prelightDone({"bake", "cornell.glb", "-o", "baked.glb", "--light-groups", "--rays", "4"});
  prelightDone({"render", "baked.glb", "-o", "a.exr", "--size", "32x32", "--shading", "lights"});
  const ProcessResult result =
      prelightDone({"render", "baked.glb", "-o", "b.exr", "--size", "32x32", "--group", "Lamp=2,2,2"});
  EXPECT_THAT(result.output, HasSubstr("lights shading"));
  const nlohmann::json difference = compare("b.exr", "a.exr");
  EXPECT_NEAR(difference["picture"]["meanA"].get<double>() / difference["picture"]["meanB"].get<double>(),
              2.0, 1e-5);
  expectFailure(2, {"render", "baked.glb", "-o", "c.exr", "--group", "lamp=2"}, {"--group lamp", "Lamp"});
}

TEST_F(CliPicture, OptionsOfAShading_WithBadValues_AreRefused) {
  const auto refused = [&](const std::string& option, const std::string& value, const std::string& expected) {
    expectFailure(2, {"render", "scene.glb", "-o", "a.exr", option, value}, {option, expected});
  };
  refused("--group", "Lamp", "Lamp=0.5");
  refused("--group", "Lamp=1,2", "one factor or three");
  refused("--haar-terms", "0", "1");
  refused("--env", "preetham:1:20", "a turbidity from 2 to 10");
  refused("--env", "preetham:3:95", "0 to 90 degrees");
  refused("--env", "preetham:3", "preetham:3:35:120");
  refused("--ao-correction", "much", "none or interreflection or cubic");
  refused("--lobe", "cone", "ggx or phong");
  refused("--debug", "chart", "charts");
  refused("--tree-depth", "64", "from 0 to 63");
}

TEST_F(CliPicture, DebugView_IsDrawnOrSaysWhatItLacks) {
  prelightDone({"render", "scene.glb", "-o", "plain.exr", "--size", "24x16", "--shading", "phong"});
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "wires.exr", "--size", "24x16",
                                             "--shading", "phong", "--debug", "wireframe"});
  EXPECT_THAT(result.errors + result.output, HasSubstr("triangles, "));
  EXPECT_GT(compare("wires.exr", "plain.exr")["picture"]["max"].get<double>(), 0.01);
  expectFailure(1, {"render", "scene.glb", "-o", "a.exr", "--shading", "phong", "--debug", "charts"},
                {"--debug charts", "there is no light map", "--shading lightmap"});
}

TEST_F(CliPicture, OptionsOfAnotherShading_AreNotedAsUnused) {
  const ProcessResult result = prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "24x16",
                                             "--haar-terms", "7", "--lobe", "phong", "--shading", "screen"});
  EXPECT_THAT(result.errors, HasSubstr("--haar-terms: ignored, because it applies to haar shading"));
  EXPECT_THAT(result.errors, HasSubstr("--lobe: ignored, because it applies to glossy and phong shading"));
}

TEST_F(CliPicture, Render_OfABuiltinScene_IsNeitherBlackNorUniform) {
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  prelightDone({"render", "shapes.glb", "-o", "a.exr", "--size", "96x64"});
  prelightDone({"render", "shapes.glb", "-o", "b.exr", "--size", "96x64", "--light", "none"});
  const nlohmann::json difference = compare("a.exr", "b.exr");
  EXPECT_GT(difference["picture"]["meanA"], 0.01);
  EXPECT_GT(difference["picture"]["rmse"], 0.001) << "the light makes no difference";
  EXPECT_EQ(difference["picture"]["notFinite"], 0);
}

TEST_F(CliPicture, Caustics_OfASceneWithGlass_AddLightAndOthersSayThatThereIsNone) {
  prelightDone({"scene", "caustics", "-o", "caustics.glb"});
  const auto render = [&](const std::string& scene, const std::string& output, bool caustics) {
    std::vector<std::string> arguments = {"render",    scene,   "-o",     output,
                                          "--shading", "phong", "--size", "96x96"};
    if (caustics) arguments.insert(arguments.end(), {"--caustics", "20000"});
    return prelightDone(arguments);
  };
  render("caustics.glb", "without.exr", false);
  EXPECT_THAT(render("caustics.glb", "with.exr", true).errors, HasSubstr("nearest ones within"));
  const nlohmann::json picture = compare("with.exr", "without.exr")["picture"];
  EXPECT_GT(picture["meanA"].get<double>(), 1.05 * picture["meanB"].get<double>());

  EXPECT_THAT(render("scene.glb", "a.exr", true).errors, HasSubstr("through mirrors or glass"));
  render("scene.glb", "b.exr", false);
  EXPECT_EQ(compare("a.exr", "b.exr")["picture"]["max"], 0.0);
}

TEST_F(CliPicture, Size_WithOneNumber_TakesTheWidthFromTheCamera) {
  const nlohmann::json render = nlohmann::json::parse(
      prelightDone({"render", "scene.glb", "-o", "a.png", "--size", "40", "--json"}).output);
  EXPECT_EQ(render["width"], 60);
  EXPECT_EQ(render["height"], 40);
}

TEST_F(CliPicture, Compare_OfAPictureWithItself_IsZero) {
  prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "48x32"});
  const nlohmann::json same = compare("a.exr", "a.exr");
  EXPECT_EQ(same["picture"]["rmse"], 0.0);
  EXPECT_EQ(same["picture"]["max"], 0.0);
}

TEST_F(CliPicture, Compare_OfBrightAndBlack_GivesTheMean) {
  prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "48x32", "--light", "point:0,3,0:20,20,20"});
  prelightDone({"render", "scene.glb", "-o", "b.exr", "--size", "48x32", "--light", "point:0,3,0:40,40,40"});
  const nlohmann::json twice = compare("b.exr", "a.exr");
  EXPECT_NEAR(twice["picture"]["meanA"].get<double>() / twice["picture"]["meanB"].get<double>(), 2.0, 0.01);
}

TEST_F(CliPicture, Compare_OfUnequalThings_IsRefused) {
  prelightDone({"render", "scene.glb", "-o", "a.exr", "--size", "48x32"});
  prelightDone({"render", "scene.glb", "-o", "b.exr", "--size", "32x32"});
  expectFailure(3, {"compare", "a.exr", "b.exr"}, {"32x32", "48x32"});
  expectFailure(2, {"compare", "a.exr", "scene.glb"}, {"a.exr", "scene.glb"});
  expectFailure(3, {"compare", "scene.glb", "scene.glb"}, {"scene.glb", "no bake"});
}

TEST_F(CliPicture, Compare_OfBakes_MeasuresEachTechnique) {
  prelightDone({"bake", "scene.glb", "-o", "a.glb", "--ao", "--sh", "2", "--rays", "64"});
  prelightDone({"bake", "scene.glb", "-o", "b.glb", "--ao", "--sh", "2", "--rays", "64", "--seed", "1"});
  const nlohmann::json difference = compare("a.glb", "b.glb");
  for (const char* technique : {"ao", "bentNormal", "sh"})
    EXPECT_TRUE(difference.contains(technique)) << technique;
  EXPECT_LT(difference["sh"]["rmse"], 0.1);
}

TEST_F(CliPicture, Screenshot_OfTheWindow_IsWhatRenderDraws) {
  SKIP_WITHOUT("xvfb-run");
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--ao", "--sh", "3", "--rays", "64"});
  prelightDone({"render", "baked.glb", "-o", "render.exr", "--size", "160x120"});
  const ProcessResult view =
      runProcess({"xvfb-run", "-a", "-s", "-screen 0 640x480x24", PRELIGHT_PROGRAM, "view", "baked.glb",
                  "--screenshot", "view.exr", "--frames", "3", "--size", "160x120"},
                 {.directory = path("")});
  ASSERT_EQ(view.exitCode, 0) << view.errors;
  EXPECT_LT(compare("view.exr", "render.exr")["picture"]["rmse"], 0.01);
}

TEST_F(CliPicture, View_WithoutADisplay_SaysSo) {
  const ProcessOptions bare{.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}};
  expectFailure(1, {"view", "scene.glb", "--frames", "1"}, {"display"}, bare);
}

}  // namespace
}  // namespace prelight::test
