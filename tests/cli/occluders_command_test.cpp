#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliOccluders : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  }

  double rmse(const std::string& a, const std::string& b) const {
    const auto json = nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output);
    return json.at("picture").at("rmse");
  }
};

TEST_F(CliOccluders, Bake_StoresRecordsAndNamesThem) {
  prelightDone({"bake", "shapes.glb", "-o", "out.glb", "--ao", "--vo", "--rays", "64"});
  const GlbScene scene = parseGlb(readFile("out.glb"));
  const auto& vo =
      scene.json.at("nodes").at(0).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0).at("vo");
  EXPECT_EQ(vo.at("stored").dump(), R"(["position","occlusion","diffuseNormal","diffuseColor"])");
  EXPECT_EQ(scene.json.at("extensions").at("PRELIGHT_transfer").at("vo").at("occluders").size(), 6u);
  const auto info = prelightDone({"info", "out.glb"});
  EXPECT_THAT(info.output, HasSubstr("6 vector occluders"));
}

TEST_F(CliOccluders, Picture_HasShadowsThatFollowTheLight) {
  prelightDone({"bake", "shapes.glb", "-o", "vo.glb", "--vo", "--rays", "256"});
  const auto render = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "vo.glb", "-o", name, "--size", "160x120"});
    prelightDone(options);
  };
  const std::string left = "point:-4,4,1:40,40,40", right = "point:4,4,1:40,40,40";
  render("phong.exr", {"--shading", "phong", "--light", left});
  render("left.exr", {"--shading", "vo", "--light", left});
  render("right.exr", {"--shading", "vo", "--light", right});
  render("thesis.exr", {"--shading", "vo", "--light", left, "--shadow-formula", "thesis"});
  render("dry.exr", {"--shading", "vo", "--light", left, "--bleeding", "0"});
  EXPECT_GT(rmse("phong.exr", "left.exr"), 0.02);
  EXPECT_GT(rmse("left.exr", "right.exr"), 0.02);
  EXPECT_GT(rmse("left.exr", "thesis.exr"), 0.005);
  EXPECT_GT(rmse("left.exr", "dry.exr"), 0.001);
}

TEST_F(CliOccluders, Effects_RepeatAfterTheirPeriod) {
  prelightDone({"bake", "shapes.glb", "-o", "vo.glb", "--vo", "--rays", "64"});
  const auto render = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "vo.glb", "-o", name, "--size", "80x60", "--shading", "vo"});
    prelightDone(options);
  };
  render("still.exr", {});
  render("zero.exr", {"--waves", "0", "--effect-time", "3"});
  render("wave.exr", {"--waves", "0.4", "--fire", "0.5", "--effect-time", "1"});
  render("later.exr", {"--waves", "0.4", "--fire", "0.5", "--effect-time", "2"});
  render("again.exr", {"--waves", "0.4", "--fire", "0.5", "--effect-time", "17"});
  EXPECT_EQ(rmse("still.exr", "zero.exr"), 0.0);
  EXPECT_EQ(rmse("wave.exr", "again.exr"), 0.0);
  EXPECT_GT(rmse("wave.exr", "later.exr"), 1e-3);
  EXPECT_GT(rmse("wave.exr", "still.exr"), 1e-3);
  render("bent.exr", {"--normal-waves", "0.5"});
  render("bent again.exr", {"--normal-waves", "0.5", "--effect-time", "8"});
  EXPECT_GT(rmse("bent.exr", "still.exr"), 1e-3);
  EXPECT_EQ(rmse("bent.exr", "bent again.exr"), 0.0);
}

TEST_F(CliOccluders, MirrorFormulas_DifferWhereSomethingMirrors) {
  prelightDone({"scene", "caustics", "-o", "caustics.glb"});
  for (const char* scene : {"shapes", "caustics"})
    prelightDone(
        {"bake", std::string(scene) + ".glb", "-o", std::string(scene) + "-vo.glb", "--vo", "--rays", "64"});
  const auto difference = [&](const std::string& scene) {
    for (const char* formula : {"lobe", "thesis"})
      prelightDone({"render", scene + "-vo.glb", "-o", std::string(formula) + ".exr", "--size", "80x60",
                    "--shading", "vo", "--mirror-formula", formula, "--specular-exponent", "2"});
    return rmse("lobe.exr", "thesis.exr");
  };
  EXPECT_GT(difference("caustics"), 1e-3);
  EXPECT_EQ(difference("shapes"), 0.0);
}

TEST_F(CliOccluders, Help_NamesRangesAndShowsAnExample) {
  for (const char* command : {"render", "view"}) {
    const std::string help = prelightDone({command, "--help"}).output;
    EXPECT_THAT(help, HasSubstr("0.2 to 5.5"));
    EXPECT_THAT(help, HasSubstr("--waves 0."));
    for (const char* option :
         {"--caustic-strength", "--diffuse-from-specular", "--specular-from-specular", "--specular-exponent",
          "--receiver", "--highlights", "--fire", "--effect-time", "--mirror-formula", "--normal-waves"})
      EXPECT_THAT(help, HasSubstr(option)) << command;
  }
}

TEST_F(CliOccluders, Auto_StoresAsManyRecordsAsAskedFor) {
  prelightDone({"bake", "shapes.glb", "-o", "out.glb", "--vo", "--occluders", "auto:5", "--rays", "64"});
  EXPECT_THAT(prelightDone({"info", "out.glb"}).output, HasSubstr("5.0 records per vertex"));
}

TEST_F(CliOccluders, Compressed_AreAQuarterAndLookTheSame) {
  const std::vector<std::string> bake = {"bake", "shapes.glb", "--vo", "--rays", "256", "-o"};
  const auto baked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), bake.begin(), bake.end());
    return prelightDone(more);
  };
  baked({"full.glb"});
  EXPECT_THAT(baked({"small.glb", "--vo-compress", "--json"}).output, HasSubstr("18 bytes per record"));
  const auto scene = static_cast<double>(readFile("shapes.glb").size());
  const double full = static_cast<double>(readFile("full.glb").size()) - scene;
  const double small = static_cast<double>(readFile("small.glb").size()) - scene;
  EXPECT_LT(small, 0.4 * full);
  // The rest of what the file holds more is JSON, and AO where it was not asked for.
  const auto told = nlohmann::json::parse(prelightDone({"info", "small.glb", "--json"}).output);
  const double bytes = told.at("baked").at("vo").at("bytes").get<double>();
  EXPECT_LT(bytes, small);
  EXPECT_GT(bytes, 0.9 * small);
  const auto render = [&](const std::string& file, const std::string& name) {
    prelightDone({"render", file, "-o", name, "--size", "160x120", "--shading", "vo", "--light",
                  "point:-4,4,1:40,40,40"});
  };
  render("full.glb", "full.exr");
  render("small.glb", "small.exr");
  EXPECT_GT(rmse("full.exr", "small.exr"), 0.0);
  EXPECT_LT(rmse("full.exr", "small.exr"), 0.003);
  const auto without = prelight({"bake", "shapes.glb", "-o", "x.glb", "--ao", "--vo-compress"});
  EXPECT_EQ(without.exitCode, badUsage);
  EXPECT_THAT(without.errors, HasSubstr("--vo"));
}

// A picture of a moved node is near one of a bake with the node at its new place. The scene of animation.md
// swings at 1 s.
TEST_F(CliOccluders, MovedNode_TakesItsShadowAlong) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  const std::vector<std::string> size = {"--size", "160x120", "--shading",
                                         "vo",     "--light", "point:-4,5,1:60,60,60"};
  const auto render = [&](const std::string& scene, const std::string& name,
                          std::vector<std::string> options) {
    options.insert(options.begin(), {"render", scene, "-o", name});
    options.insert(options.end(), size.begin(), size.end());
    return prelightDone(options);
  };
  prelightDone({"bake", "swing.glb", "-o", "vo.glb", "--vo", "--rays", "1024"});
  render("vo.glb", "rest.exr", {});
  render("vo.glb", "moved.exr", {"--at", "1"});
  render("swing.glb", "there.exr", {"--at", "1", "--rays", "1024"});
  EXPECT_LT(rmse("moved.exr", "there.exr"), 0.4 * rmse("rest.exr", "there.exr"));

  prelightDone({"bake", "shapes.glb", "-o", "shapes-vo.glb", "--vo", "--rays", "64"});
  render("shapes-vo.glb", "here.exr", {});
  render("shapes-vo.glb", "still.exr", {"--move", "Box:0,0,0"});
  render("shapes-vo.glb", "far.exr", {"--move", "Box:1,0,0.5:45", "--move", "T*:0,1,0"});
  EXPECT_EQ(rmse("here.exr", "still.exr"), 0.0);
  EXPECT_GT(rmse("here.exr", "far.exr"), 0.02);
}

TEST_F(CliOccluders, WrongMove_IsExplained) {
  for (const char* move : {"Box", ":1,2,3", "Box:1,2", "Box:1,2,x", "Box:1,2,3:", "Box:1", "Box:1,2,3:4:5"}) {
    const auto result = prelight({"render", "shapes.glb", "-o", "x.png", "--move", move});
    EXPECT_EQ(result.exitCode, badUsage) << move;
    EXPECT_THAT(result.errors, HasSubstr("NODE:x,y,z")) << move;
  }
  const auto result = prelight({"render", "shapes.glb", "-o", "x.png", "--move", "Cow:1,2,3"});
  EXPECT_EQ(result.exitCode, badUsage);
  EXPECT_THAT(result.errors, HasSubstr("no node with a mesh"));
}

TEST_F(CliOccluders, WrongUse_IsExplained) {
  for (const char* kind : {"auto", "auto:", "auto:0", "auto:300", "auto:4x"})
    expectFailure(badUsage, {"bake", "shapes.glb", "-o", "x.glb", "--vo", "--occluders", kind},
                  {"--occluders"});
  expectFailure(badUsage, {"bake", "shapes.glb", "-o", "x.glb", "--vo", "--occluders", "triangle"},
                {"--occluders", "node, mesh, material or auto:N"});
  expectFailure(badUsage, {"bake", "shapes.glb", "-o", "x.glb", "--vo", "--vo-min-form-factor", "2"},
                {"--vo-min-form-factor"});
  expectFailure(badUsage, {"render", "shapes.glb", "-o", "x.png", "--shading", "vo", "--sky-lights", "0"},
                {"--sky-lights"});
  expectFailure(badUsage,
                {"render", "shapes.glb", "-o", "x.png", "--shading", "vo", "--shadow-formula", "hard"},
                {"--shadow-formula", "soft"});
  const std::vector<std::pair<const char*, const char*>> wrong = {{"--shadow-strength", "-1"},
                                                                  {"--shadow-strength", "101"},
                                                                  {"--caustic-strength", "-0.1"},
                                                                  {"--bleeding", "-101"},
                                                                  {"--specular-exponent", "0.5"},
                                                                  {"--specular-exponent", "1001"},
                                                                  {"--diffuse-from-specular", "-1"},
                                                                  {"--receiver", "phong"},
                                                                  {"--specular-from-specular", "nan"},
                                                                  {"--highlights", "none"},
                                                                  {"--waves", "-1"},
                                                                  {"--fire", "1.5"},
                                                                  {"--wave-length", "-1"},
                                                                  {"--effect-time", "soon"}};
  for (const auto& [option, value] : wrong)
    expectFailure(badUsage, {"render", "shapes.glb", "-o", "x.png", "--shading", "vo", option, value},
                  {option});
}

}  // namespace
}  // namespace prelight::test
