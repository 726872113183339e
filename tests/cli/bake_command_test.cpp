#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <numeric>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliBake : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  /// Bakes scene.glb quickly and returns the baked file.
  GlbScene bake(const std::string& output, const std::vector<std::string>& options,
                ProcessOptions process = {}) const {
    std::vector<std::string> arguments = {"bake", "scene.glb", "-o", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    prelightDone(arguments, std::move(process));
    return parseGlb(readFile(output));
  }

  static const nlohmann::ordered_json& baked(const GlbScene& scene, std::size_t node) {
    return scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
  }

  /// All baked numbers of the file, in file order.
  static std::vector<float> values(const GlbScene& scene) {
    std::vector<float> all;
    for (std::size_t node = 0; node < 2; ++node) {
      const auto& entry = baked(scene, node);
      for (std::size_t accessor :
           {entry.at("ao"), entry.at("bentNormal"), entry.at("sh").at("coefficients")}) {
        const std::vector<float> part = floatAccessor(scene, accessor);
        all.insert(all.end(), part.begin(), part.end());
      }
    }
    return all;
  }
};

const std::vector<std::string> quick = {"--ao", "--sh", "3", "--bounces", "1", "--rays", "64"};

TEST_F(CliBake, Output_IsTheInputWithTheExtension) {
  const GlbScene result = bake("out.glb", quick);
  EXPECT_THAT(result.json.at("extensionsUsed"), ::testing::Contains("PRELIGHT_transfer"));
  EXPECT_FALSE(result.json.contains("extensionsRequired"));
  const GlbScene input = floorAndRoof();
  EXPECT_EQ(result.json.at("meshes"), input.json.at("meshes"));
  EXPECT_EQ(result.json.at("materials"), input.json.at("materials"));
  const auto& root = result.json.at("extensions").at("PRELIGHT_transfer");
  for (const char* key :
       {"version", "generator", "seed", "rays", "error", "bounces", "plan", "device", "seconds"})
    EXPECT_TRUE(root.contains(key)) << key;
  const auto& sh = baked(result, 0).at("sh");
  EXPECT_EQ(sh.at("order"), 3);
  EXPECT_EQ(sh.at("channels"), 3);
  EXPECT_EQ(sh.at("bounces"), 1);
  EXPECT_EQ(floatAccessor(result, sh.at("coefficients")).size(), 4u * 3u * 9u);
  EXPECT_FALSE(result.json.at("nodes").at(2).contains("extensions")) << "the camera's node has no mesh";
}

TEST_F(CliBake, Values_OfFloorUnderRoof_ArePlausible) {
  const GlbScene result = bake("out.glb", {"--ao", "--sh", "3", "--bounces", "1", "--rays", "1024"});
  for (float value : values(result)) ASSERT_TRUE(std::isfinite(value));
  for (float ao : floatAccessor(result, baked(result, 1).at("ao")))
    EXPECT_FLOAT_EQ(ao, 1.0f) << "nothing is above the roof";
  for (float ao : floatAccessor(result, baked(result, 0).at("ao"))) {
    EXPECT_GT(ao, 0.6f) << "the floor's corners lie in the open";
    EXPECT_LE(ao, 1.0f);
  }
}

TEST_F(CliBake, NoTechniqueNamed_BakesTheDefaultAndSaysSo) {
  const ProcessResult result = prelightDone({"bake", "scene.glb", "-o", "out.glb", "--rays", "16"});
  EXPECT_THAT(result.errors, HasSubstr("--ao --sh 3 --bounces 1"));
  const GlbScene scene = parseGlb(readFile("out.glb"));
  EXPECT_TRUE(baked(scene, 0).contains("ao"));
  EXPECT_EQ(baked(scene, 0).at("sh").at("order"), 3);
}

/// A volume has the order of the SH transfer, so it is no technique by itself.
TEST_F(CliBake, VolumeAlone_HasTheDefaultTransfer) {
  const ProcessResult result =
      prelightDone({"bake", "scene.glb", "-o", "air.glb", "--volume", "2", "--rays", "8"});
  EXPECT_THAT(result.errors, HasSubstr("--ao --sh 3 --volume 2 --bounces 1"));
}

TEST_F(CliBake, Seed_Same_GivesTheSameBytesForAnyThreadCount) {
  const auto threads = [](const char* count) {
    return ProcessOptions{.environment = {{"POCL_MAX_PTHREAD_COUNT", count}}};
  };
  const GlbScene one = bake("one.glb", quick, threads("1"));
  const GlbScene two = bake("two.glb", quick, threads("2"));
  EXPECT_EQ(one.bin, two.bin);
}

TEST_F(CliBake, Seed_Other_GivesOtherBytesAndTheSameLight) {
  std::vector<std::string> options = quick;
  options.insert(options.end(), {"--seed", "99"});
  const std::vector<float> first = values(bake("one.glb", quick));
  const std::vector<float> second = values(bake("two.glb", options));
  ASSERT_EQ(first.size(), second.size());
  EXPECT_NE(first, second);
  double squares = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) squares += (first[i] - second[i]) * (first[i] - second[i]);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(first.size())), 0.1);
}

TEST_F(CliBake, BakedInput_HasItsDataReplaced) {
  const GlbScene once = bake("once.glb", quick);
  prelightDone(
      {"bake", "once.glb", "-o", "twice.glb", "--ao", "--sh", "3", "--bounces", "1", "--rays", "64"});
  const GlbScene twice = parseGlb(readFile("twice.glb"));
  EXPECT_EQ(values(once), values(twice));
  EXPECT_EQ(once.bin.size(), twice.bin.size());
  EXPECT_EQ(once.json.at("accessors").size(), twice.json.at("accessors").size());

  prelightDone({"bake", "once.glb", "-o", "once.glb", "--ao", "--rays", "16"});
  const GlbScene less = parseGlb(readFile("once.glb"));
  EXPECT_FALSE(baked(less, 0).contains("sh"));
  EXPECT_LT(less.bin.size(), once.bin.size());
}

TEST_F(CliBake, Report_HoldsWhatTheBakeDid) {
  bake("out.glb", {"--ao", "--sh", "2", "--rays", "64", "--seed", "5", "--report", "report.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("report.json"));
  for (const char* key :
       {"command", "version", "scene", "output", "options", "seed", "device", "stages", "seconds", "rays",
        "raysPerSecond", "receivers", "estimatedError", "memory", "plan", "warnings"})
    EXPECT_TRUE(report.contains(key)) << key;
  EXPECT_EQ(report["seed"], 5);
  EXPECT_EQ(report["options"]["sh"], 2);
  EXPECT_GT(report["rays"], 0);
  EXPECT_GT(report["memory"]["peakResident"], 1 << 20);
  for (const char* stage : {"load", "compile", "plan", "device", "write"})
    EXPECT_TRUE(report["stages"].contains(stage)) << stage;
}

TEST_F(CliBake, Json_OnStdoutIsTheReport) {
  const ProcessResult result = prelightDone(
      {"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "16", "--json", "--report", "report.json"});
  const nlohmann::json printed = nlohmann::json::parse(result.output);
  const nlohmann::json written = nlohmann::json::parse(readFile("report.json"));
  EXPECT_EQ(printed["command"], "bake");
  EXPECT_EQ(printed["rays"], written["rays"]);
}

TEST_F(CliBake, Quiet_SaysNothing) {
  const ProcessResult result =
      prelightDone({"bake", "scene.glb", "-o", "out.glb", "--rays", "16", "--quiet"});
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(result.errors, "");
}

TEST_F(CliBake, Progress_OnlyOnATerminal) {
  const std::vector<std::string> command = {"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "256"};
  EXPECT_THAT(prelightDone(command).errors, Not(HasSubstr("\r")));
  const ProcessOptions terminal{.environment = {{"TERM", "xterm"}, {"NO_COLOR", "1"}},
                                .errorOnTerminal = true};
  const ProcessResult shown = prelightDone(command, terminal);
  EXPECT_THAT(shown.errors, HasSubstr(" %"));
  EXPECT_THAT(shown.errors, Not(HasSubstr("\x1b")));
}

TEST_F(CliBake, Interrupt_StopsWithoutOutput) {
  prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  const std::set<std::string> before = files();
  for (const int signal : {SIGINT, SIGTERM}) {
    const ProcessResult result =
        prelight({"bake", "cornell.glb", "-o", "out.glb", "--ao", "--sh", "8", "--rays", "1048576"},
                 {.signalAfterOutput = signal});
    EXPECT_EQ(result.exitCode, interrupted) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("interrupted"));
    std::set<std::string> after = files();
    after.erase("out.glb.state");  // The state exists once rays have been cast.
    EXPECT_EQ(after, before);
  }
}

class CliResume : public CliBake {
 protected:
  void SetUp() override {
    CliBake::SetUp();
    prelightDone({"scene", "cornell", "-o", "cornell.glb"});
  }

  ProcessResult bakeCornell(const std::string& output, const std::vector<std::string>& options,
                            std::optional<int> signal = {}) const {
    std::vector<std::string> arguments = {"bake", "cornell.glb", "-o", output, "--ao", "--sh", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelight(arguments, {.signalAfterOutput = signal});
  }

  bool stateExists() const { return std::filesystem::exists(path("out.glb.state")); }

  /// Bakes with options that take far longer than the wait, until a state exists.
  void interruptLongBake(const std::vector<std::string>& options) const {
    for (int attempt = 0; attempt < 5 && !stateExists(); ++attempt)
      EXPECT_EQ(bakeCornell("out.glb", options, SIGINT).exitCode, interrupted);
    ASSERT_TRUE(stateExists());
  }

  /// Contents of a baked file without the time that the bake took.
  static std::pair<nlohmann::ordered_json, std::string> content(const GlbScene& scene) {
    nlohmann::ordered_json json = scene.json;
    json.at("extensions").at("PRELIGHT_transfer").erase("seconds");
    return {json, scene.bin};
  }
};

TEST_F(CliResume, InterruptedAndContinued_EndsAsIfNeverInterrupted) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--bounces", "1", "--rays", "3072"},
        {"--error", "0.01", "--seed", "3"},
        {"--haar", "16", "--glossy", "2", "--light-groups", "--bounces", "1", "--rays", "2048"},
        {"--vo", "--occluders", "auto:8", "--rays", "3072"}}) {
    EXPECT_EQ(bakeCornell("whole.glb", options).exitCode, 0);
    std::vector<std::string> resuming = options;
    resuming.emplace_back("--resume");
    int interruptions = 0, states = 0;
    ProcessResult result;
    do {
      result =
          bakeCornell("out.glb", resuming, interruptions < 3 ? std::optional<int>(SIGINT) : std::nullopt);
      interruptions += result.exitCode == interrupted;
      if (result.exitCode == interrupted) states += stateExists();
    } while (result.exitCode == interrupted);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_GT(states, 0) << "no run came as far as casting before it was interrupted";
    EXPECT_THAT(result.errors, HasSubstr("continuing"));
    EXPECT_FALSE(stateExists()) << "done, the state is of no more use";
    EXPECT_EQ(content(parseGlb(readFile("out.glb"))), content(parseGlb(readFile("whole.glb"))));
  }
}

/// The state that is left after a power cut, or after the kernel killed a process for its memory.
TEST_F(CliResume, Killed_LeavesAStateToGoOnWith) {
  const ProcessResult killed =
      runProcess({"/bin/bash", "-c",
                  "$P bake cornell.glb -o out.glb --ao --sh 2 --rays 1048576 & pid=$!;"
                  "until [ -e out.glb.state ]; do sleep 0.1; kill -0 $pid || exit 1; done; kill -9 $pid; "
                  "wait $pid; exit 0"},
                 {.directory = path(""), .environment = {{"P", PRELIGHT_PROGRAM}}});
  ASSERT_EQ(killed.exitCode, 0) << killed.errors;
  EXPECT_EQ(files(), (std::set<std::string>{"scene.glb", "cornell.glb", "out.glb.state"}));
  const ProcessResult resumed = bakeCornell("out.glb", {"--rays", "1048576", "--resume"}, SIGINT);
  EXPECT_EQ(resumed.exitCode, interrupted);
  EXPECT_THAT(resumed.errors, HasSubstr("continuing"));
}

TEST_F(CliResume, StateOfAnotherBake_IsBadUsage) {
  interruptLongBake({"--rays", "1048576", "--seed", "1"});
  const std::string state = readFile("out.glb.state");
  const ProcessResult seed = bakeCornell("out.glb", {"--rays", "1048576", "--seed", "2", "--resume"});
  EXPECT_EQ(seed.exitCode, 2);
  EXPECT_THAT(seed.errors, HasSubstr("another seed"));
  const ProcessResult options = bakeCornell("out.glb", {"--rays", "64", "--seed", "1", "--resume"});
  EXPECT_EQ(options.exitCode, 2);
  EXPECT_THAT(options.errors, HasSubstr("another options"));
  prelightDone({"scene", "shapes", "-o", "cornell.glb"});
  const ProcessResult scene = bakeCornell("out.glb", {"--rays", "1048576", "--seed", "1", "--resume"});
  EXPECT_EQ(scene.exitCode, 2);
  EXPECT_THAT(scene.errors, HasSubstr("another scene"));
  EXPECT_EQ(readFile("out.glb.state"), state) << "a refusal leaves the state alone";
}

TEST_F(CliResume, DamagedState_IsBadInput) {
  interruptLongBake({"--rays", "1048576"});
  std::string state = readFile("out.glb.state");
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] ^ 1);
  writeFile("out.glb.state", state);
  const ProcessResult result = bakeCornell("out.glb", {"--rays", "1048576", "--resume"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_THAT(result.errors, HasSubstr("out.glb.state"));
  EXPECT_THAT(result.errors, HasSubstr("damaged"));
}

TEST_F(CliResume, NoState_StartsFromTheBeginningAndSaysSo) {
  const ProcessResult result = bakeCornell("out.glb", {"--rays", "16", "--resume"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.errors, HasSubstr("from the beginning"));
}

TEST_F(CliBake, Interrupt_WhileKernelsCompile_IsAnInterruptToo) {
  std::filesystem::create_directory(path("cache"));  // An empty cache makes PoCL compile.
  const ProcessResult result =
      prelight({"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "1048576", "--no-cache-kernels"},
               {.environment = {{"POCL_CACHE_DIR", path("cache").string()}}, .signalAfterOutput = SIGINT});
  EXPECT_EQ(result.exitCode, interrupted) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(path("out.glb")));
}

TEST_F(CliBake, Kernels_DumpedOnRequest) {
  bake("out.glb", {"--ao", "--rays", "16", "--no-cache-kernels", "--dump-kernels", "kernels"});
  EXPECT_FALSE(std::filesystem::is_empty(path("kernels")));
}

TEST_F(CliBake, Environment_IsAcceptedWithAWarning) {
  writeFile("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81");
  const ProcessResult result =
      prelightDone({"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "16", "--env", "sky.hdr"});
  EXPECT_THAT(result.errors, HasSubstr("--env"));
}

}  // namespace
}  // namespace prelight::test
