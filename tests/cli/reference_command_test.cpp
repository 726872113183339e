#include <gmock/gmock.h>
#include <signal.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliReference : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  static std::vector<std::string> command(const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"reference", "scene.glb", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(CliReference, Json_TellsHowThePictureWasMade) {
  const auto result =
      prelightDone(command("a.exr", {"--size", "24x16", "--spp", "64", "--depth", "4", "--json"}));
  const nlohmann::json report = nlohmann::json::parse(result.output);
  EXPECT_EQ(report["spp"], 64);
  EXPECT_EQ(report["width"], 24);
  EXPECT_EQ(report["height"], 16);
  EXPECT_EQ(report["depth"], 4);
  EXPECT_GT(report["rays"], 24 * 16 * 64);
  EXPECT_GT(report["error"], 0.0);
  EXPECT_GT(report["plan"].size(), 3u);
  EXPECT_THAT(readFile("a.exr"), HasSubstr("variance.Y"));
}

TEST_F(CliReference, Bytes_DependOnSeedButNotOnThreads) {
  const std::vector<std::string> options{"--size", "24x16", "--spp", "64"};
  prelightDone(command("a.exr", options));
  prelightDone(command("b.exr", options),
               {.environment = {{"POCL_MAX_PTHREAD_COUNT", "1"}, {"POCL_CPU_MAX_CU_COUNT", "1"}}});
  EXPECT_EQ(readFile("a.exr"), readFile("b.exr"));
  std::vector<std::string> other = options;
  other.insert(other.end(), {"--seed", "1"});
  prelightDone(command("c.exr", other));
  EXPECT_NE(readFile("a.exr"), readFile("c.exr"));
}

TEST_F(CliReference, Interrupted_IsResumedToTheSameBytes) {
  const std::vector<std::string> options{"--size", "96x64", "--spp", "2048"};
  prelightDone(command("whole.exr", options));
  // The scene's line is on stdout before tracing begins.
  const ProcessResult stopped = prelight(command("a.exr", options), {.signalAfterOutput = SIGINT});
  if (stopped.exitCode == interrupted) {
    EXPECT_EQ(files().count("a.exr"), 0u);
    EXPECT_EQ(files().count("a.exr.state"), 1u);
    EXPECT_THAT(stopped.errors, HasSubstr("--resume"));
    std::vector<std::string> other{"--size", "96x64", "--spp", "2048", "--seed", "5", "--resume"};
    expectFailure(badUsage, command("a.exr", other), {"a.exr.state", "another seed"});
  }
  std::vector<std::string> resumed = options;
  resumed.push_back("--resume");
  prelightDone(command("a.exr", resumed));
  EXPECT_EQ(readFile("a.exr"), readFile("whole.exr"));
  EXPECT_EQ(files().count("a.exr.state"), 0u);
}

TEST_F(CliReference, ResumeWithoutState_StartsAnewAndSaysSo) {
  const auto result = prelightDone(command("a.exr", {"--size", "8x8", "--spp", "4", "--resume"}));
  EXPECT_THAT(result.errors, HasSubstr("starting from the beginning"));
}

TEST_F(CliReference, OneSample_HasNoVarianceAndSaysSo) {
  const auto result = prelightDone(command("a.exr", {"--size", "8x8", "--spp", "1"}));
  EXPECT_THAT(result.errors, HasSubstr("variance"));
}

TEST_F(CliReference, Options_WrongOrExclusive_AreRefusedByName) {
  const std::vector<std::pair<const char*, std::vector<const char*>>> cases = {
      {"--spp", {"0", "-1", "1.5", "x"}}, {"--depth", {"0", "2000", "two"}},
      {"--error", {"0", "2", "nan"}},     {"--time", {"0", "-1", "inf"}},
      {"--seed", {"-1", "1.5"}},          {"--size", {"0", "4x", "wide"}},
      {"--camera", {"-1", "a"}},          {"--rotate-env", {"nan"}},
      {"--integrator", {"photon", ""}}};
  for (const auto& [option, values] : cases)
    for (const char* value : values)
      expectFailure(badUsage, command("a.exr", {option, value}),
                    {option, "got '" + std::string(value) + "'", "expected"});
  expectFailure(badUsage, command("a.exr", {"--spp", "4", "--error", "0.1"}), {"--spp", "--error"});
  expectFailure(badUsage, command("a.exr", {"--spp", "4", "--time", "1"}), {"--spp", "--time"});
  expectFailure(badUsage, command("a.exr", {"--light", "lamp"}), {"--light", "lamp"});
  expectFailure(badUsage, command("a.exr", {"--camera", "7"}), {"--camera 7"});
  expectFailure(badUsage, command("a.png", {}), {"-o", ".exr"});
}

TEST_F(CliReference, Inputs_MissingOrBroken_AreRefused) {
  expectFailure(badInput, {"reference", "none.glb", "-o", "a.exr"}, {"none.glb"});
  expectFailure(badInput, command("a.exr", {"--env", "none.exr"}), {"none.exr"});
  writeFile("empty.glb", emptyScene().bytes());
  expectFailure(badInput, {"reference", "empty.glb", "-o", "a.exr"}, {"empty.glb", "triangles"});
  writeFile("a.exr.state", "not a state");
  expectFailure(badInput, command("a.exr", {"--size", "8x8", "--resume"}), {"a.exr.state"});
}

}  // namespace
}  // namespace prelight::test
