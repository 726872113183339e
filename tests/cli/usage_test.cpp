#include <gmock/gmock.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliUsage : public CliTest {};

TEST_F(CliUsage, Help_OfProgramAndEveryCommand_ShowsAnExample) {
  EXPECT_THAT(prelightDone({"--help"}).output, HasSubstr("Example"));
  for (const char* command :
       {"bake", "render", "reference", "view", "export", "info", "scene", "devices", "compare", "help"}) {
    const ProcessResult help = prelightDone({command, "--help"});
    EXPECT_THAT(help.output, HasSubstr("Examples:")) << command;
    EXPECT_THAT(help.output, HasSubstr(std::string("prelight ") + command));
  }
}

TEST_F(CliUsage, HelpOfTasks_ListsThemAndShowsCommands) {
  EXPECT_THAT(prelightDone({"help"}).output, HasSubstr("prelight help lightmap"));
  EXPECT_THAT(prelightDone({"help", "start"}).output, HasSubstr("prelight bake shapes.glb"));
  EXPECT_EQ(prelightDone({"help", "bake"}).output, prelightDone({"bake", "--help"}).output);
  expectFailure(badUsage, {"help", "lihgtmap"}, {"lihgtmap", "did you mean lightmap?"});
  expectFailure(badUsage, {}, {"prelight help"});
}

/// Runs the commands as they are to be typed, except those that open a window.
TEST_F(CliUsage, CommandsOfTheFirstTask_Run) {
  std::istringstream lines(prelightDone({"help", "start"}).output);
  std::size_t commands = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    if (arguments.empty() || arguments[0] != "prelight" || arguments[1] == "view") continue;
    arguments.erase(arguments.begin());
    prelightDone(arguments);
    ++commands;
  }
  EXPECT_EQ(commands, 3u);
}

TEST_F(CliUsage, Version_IsPrintedWithItsCommit) {
  const std::string version = prelightDone({"--version"}).output;
  EXPECT_THAT(version, ::testing::MatchesRegex("prelight [0-9]+\\.[0-9]+\\.[0-9]+ \\([-.a-z0-9 ]+\\)\n"));
  const nlohmann::json report = nlohmann::json::parse(prelightDone({"scene", "--list", "--json"}).output);
  EXPECT_THAT(version, HasSubstr("prelight " + report.at("version").get<std::string>()));
  EXPECT_THAT(report.at("commit").get<std::string>(), ::testing::MatchesRegex("[0-9a-f]{40,64}|unknown"));
}

TEST_F(CliUsage, Command_MissingOrUnknown_NamesTheKnownOnes) {
  expectFailure(badUsage, {}, {"command is required", "bake", "render"});
  expectFailure(badUsage, {"frobnicate"}, {"frobnicate", "unknown command", "bake", "render"});
}

TEST_F(CliUsage, Name_Mistyped_SuggestsTheNearest) {
  expectFailure(badUsage, {"rneder"}, {"did you mean render?"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--bounecs=2"}, {"did you mean --bounces?"});
  expectFailure(badUsage, {"scene", "cornel", "-o", "x.glb"}, {"did you mean cornell?"});
  expectFailure(badUsage, {"render", "x.glb", "-o", "y.png", "--shading", "ligths"},
                {"did you mean lights?"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--solver", "jacoby"},
                {"--solver", "did you mean jacobi?"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--encode", "ambient-cub"},
                {"--encode", "did you mean ambient-cube?"});
  expectFailure(badUsage, {"export", "x.glb", "-o", "y", "--target", "thre"},
                {"--target", "did you mean three?", "blender"});
  expectFailure(badUsage, {"reference", "x.glb", "-o", "y.exr", "--integrator", "pathh"},
                {"--integrator", "did you mean path?", "whitted"});
  EXPECT_THAT(prelight({"frobnicate"}).errors, Not(HasSubstr("did you mean")));
}

TEST_F(CliUsage, Arguments_MissingOrTooMany_AreNamed) {
  expectFailure(badUsage, {"bake"}, {"SCENE"});
  expectFailure(badUsage, {"bake", "x.glb"}, {"--output"});
  expectFailure(badUsage, {"bake", "x.glb", "z.glb", "-o", "y.glb"}, {"z.glb"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--rays"}, {"--rays", "value"});
  expectFailure(badUsage, {"scene"}, {"NAME"});
  expectFailure(badUsage, {"scene", "shapes"}, {"-o"});
  expectFailure(badUsage, {"compare", "a.exr"}, {"B"});
}

TEST_F(CliUsage, Technique_ThatDoesNotExist_NamesThoseThatDo) {
  for (const char* option : {"--photon-map", "--radiance"})
    expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", option}, {option, "--ao", "--sh"});
  for (const char* shading : {"lightmaps", "none", ""})
    expectFailure(badUsage, {"render", "x.glb", "-o", "y.png", "--shading", shading},
                  {"phong, ao, sh, ch, haar, glossy, lights, vo"});
}

TEST_F(CliUsage, Options_ThatExcludeEachOther_AreRefused) {
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--rays", "4", "--error", "0.1"},
                {"--rays", "--error"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--rays", "4", "--time", "1"},
                {"--rays", "--time"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--time", "4", "--error", "0.1"},
                {"--time", "--error"});
  expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", "--cache-kernels", "--no-cache-kernels"},
                {"--cache-kernels"});
  expectFailure(badUsage, {"devices", "--quiet", "--verbose"}, {"--quiet", "--verbose"});
}

TEST_F(CliUsage, Values_NegativeOrAbsurd_AreRefusedByName) {
  const std::vector<std::pair<const char*, std::vector<const char*>>> cases = {
      {"--sh", {"0", "-1", "33", "1.5", "three", "", "99999999999999999999"}},
      {"--ch", {"0", "-1", "33", "1.5", "three", ""}},
      {"--glossy", {"0", "-1", "9", "two"}},
      {"--haar", {"0", "-8", "3", "48", "256", "16.0", "large", ""}},
      {"--haar-error", {"-0.1", "1.1", "nan"}},
      {"--near", {"-1", "nan"}},
      {"--far", {"0", "-1", "inf"}},
      {"--obscurance", {"0", "-1", "nan"}},
      {"--light-group", {"lamps", "=Lamp*", "lamps="}},
      {"--shadow-set", {"floor", ":roof", "a:b:c", ",:roof"}},
      {"--compress", {"zip", "pca", "pca:0", "vq:0", "cpca:4", "cpca:x:y", ""}},
      {"--bounces", {"-1", "17", "99", "nan"}},
      {"--rays", {"0", "-5", "1e3", "2000000", "18446744073709551616"}},
      {"--error", {"0", "-0.1", "nan", "inf", "2", "x"}},
      {"--time", {"0", "-1", "nan", "inf", "1e30"}},
      {"--seed", {"-1", "1.5", "18446744073709551616"}},
      {"--max-memory", {"0", "-1", "1", "5X", "G", "99999999999G"}}};
  for (const auto& [option, values] : cases)
    for (const char* value : values)
      expectFailure(badUsage, {"bake", "x.glb", "-o", "y.glb", option, value},
                    {std::string(option) + ": got '" + value + "'", "expected"});
}

TEST_F(CliUsage, PictureValues_NegativeOrAbsurd_AreRefusedByName) {
  const std::vector<std::pair<const char*, std::vector<const char*>>> cases = {
      {"--size", {"0", "0x5", "5x0", "-4", "4x", "x4", "1e9", "1000000000", "4x4x4", "wide"}},
      {"--camera", {"-1", "a", "1e9"}},
      {"--rotate-env", {"nan", "inf", "1e9", "left"}}};
  for (const auto& [option, values] : cases)
    for (const char* value : values)
      expectFailure(badUsage, {"render", "x.glb", "-o", "y.png", option, value},
                    {std::string(option) + ": got '" + value + "'", "expected"});
  for (const char* light :
       {"lamp", "point:0,0,0", "point:0,0:1,1,1", "directional:0,0,0:1,1,1", "point:0,0,0:1,nan,1"})
    expectFailure(badUsage, {"render", "x.glb", "-o", "y.png", "--light", light}, {"--light", light});
  expectFailure(badUsage, {"view", "x.glb", "--frames", "0"}, {"--frames"});
  expectFailure(badUsage, {"view", "x.glb", "--frames", "1000001"}, {"--frames", "1000000"});
  expectFailure(3, {"view", "x.glb", "--frames", "1000000"}, {"x.glb"});
  expectFailure(badUsage, {"view", "x.glb", "--screenshot", "a.png"}, {"--screenshot", "--frames"});
}

TEST_F(CliUsage, Camera_ThatTheSceneLacks_IsRefused) {
  writeFile("scene.glb", floorAndRoof().bytes());
  expectFailure(badUsage, {"render", "scene.glb", "-o", "y.png", "--camera", "1"}, {"camera"});
}

TEST_F(CliUsage, GlobalOptions_BeforeOrAfterTheCommand_MeanTheSame) {
  const ProcessResult before = prelightDone({"--json", "scene", "--list"});
  const ProcessResult after = prelightDone({"scene", "--list", "--json"});
  EXPECT_EQ(before.output, after.output);
  EXPECT_TRUE(nlohmann::json::accept(before.output)) << before.output;
}

TEST_F(CliUsage, OutputExtension_Wrong_IsRefusedBeforeWork) {
  writeFile("scene.glb", floorAndRoof().bytes());
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "out.txt"}, {"-o", "out.txt", ".glb"});
  expectFailure(badUsage, {"render", "scene.glb", "-o", "out.tiff"}, {"-o", "out.tiff", ".exr", ".png"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "out.glb", "--report", "report.txt"},
                {"--report", ".json"});
  expectFailure(badUsage, {"scene", "shapes", "-o", "out.obj"}, {"-o", ".glb"});
}

TEST_F(CliUsage, BuiltinScene_Unknown_ListsTheKnownOnes) {
  expectFailure(badUsage, {"scene", "teapot", "-o", "out.glb"}, {"teapot", "shapes", "cornell"});
}

TEST_F(CliUsage, Error_IsOneLineWithoutColour) {
  const ProcessResult result = prelight({"bake", "x.glb", "-o", "y.glb", "--sh", "9"});
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1);
  EXPECT_THAT(result.errors, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace prelight::test
