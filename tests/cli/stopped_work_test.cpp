// Work that is stopped or killed at random moments, and then resumed. PRELIGHT_STOPS sets the number of
// moments over all techniques; the default is small to keep the test short.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using Arguments = std::vector<std::string>;

/// A command without its output and --resume.
struct Work {
  const char* scene;   ///< A built-in scene, or "chart".
  Arguments options;   ///< Options, after the command.
  bool quick = false;  ///< Whether the work is tried when only a few moments are.
};

const std::vector<Work>& works() {
  static const std::vector<Work> all = {
      {"cornell", {"bake", "--ao", "--sh", "4", "--bounces", "2", "--rays", "2048"}, true},
      {"cornell", {"bake", "--haar", "8", "--glossy", "3", "--bounces", "1", "--rays", "1024"}, true},
      {"cornell",
       {"bake", "--lightmap", "--texel-error", "0.1", "--rays", "32", "--photons", "100000"},
       true},
      {"swing",
       {"bake", "--sh", "3", "--bounces", "1", "--animation", "0", "--keys", "5", "--rays", "4096"},
       true},
      {"cornell", {"reference", "--spp", "128", "--size", "96"}, true},
      {"cornell", {"bake", "--ao", "--error", "0.01"}},
      {"cornell", {"bake", "--ch", "4", "--sh", "4", "--light-groups", "--bounces", "3", "--rays", "512"}},
      {"cornell", {"bake", "--sh", "6", "--bounces", "1", "--compress", "cpca:16:6", "--rays", "512"}},
      {"cornell", {"bake", "--sh", "3", "--bounces", "1", "--volume", "12", "--rays", "512"}},
      {"shapes", {"bake", "--vo", "--occluders", "auto:8", "--vo-compress", "--rays", "512"}},
      {"shapes", {"bake", "--ao", "--cones", "--horizons", "16", "--near-lamps", "8", "--rays", "1024"}},
      {"cornell", {"bake", "--radiosity", "--patch-size", "0.1", "--rays", "2048"}},
      {"caustics", {"bake", "--lightmap", "--caustics", "--photons", "1000000", "--rays", "32"}},
      {"caustics", {"bake", "--sh", "4", "--bounces", "2", "--specular-transport", "--rays", "256"}},
      {"shapes", {"bake", "--lightmap", "--rays", "128"}, true},
      {"cornell", {"bake", "--lightmap", "--encode", "ahd", "--rays", "64"}},
      {"chart", {"bake", "--sh", "3", "--texels", "256", "--bounces", "1", "--rays", "256"}},
      {"rooms", {"reference", "--integrator", "instant", "--spp", "32", "--size", "96"}}};
  return all;
}

class StoppedWork : public CliTest, public ::testing::WithParamInterface<std::size_t> {
 protected:
  const Work& work() const { return works()[GetParam()]; }
  bool draws() const { return work().options.front() == "reference"; }
  std::string suffix() const { return draws() ? ".exr" : ".glb"; }

  void makeScene() const {
    const std::string name = work().scene;
    if (name == "chart")
      writeFile("in.glb", floorAndRoofWithChart(true).bytes());
    else
      prelightDone({"scene", name, "-o", "in.glb"});
  }

  Arguments command(const std::string& output, bool resumes) const {
    Arguments arguments = {work().options.front(), "in.glb", "-o", output + suffix()};
    arguments.insert(arguments.end(), work().options.begin() + 1, work().options.end());
    if (resumes) arguments.emplace_back("--resume");
    return arguments;
  }

  /// Starts the work and sends a signal after `seconds`. Returns the exit status as a shell reports it.
  int signalled(const Arguments& arguments, double seconds, int signal) {
    const pid_t process = ::fork();
    if (process == 0) {
      if (::chdir(path("").c_str()) != 0) ::_exit(127);
      setenv("PRELIGHT_STATE_SECONDS", "0.1", 1);
      if (std::freopen("/dev/null", "w", stdout) == nullptr ||
          std::freopen("/dev/null", "w", stderr) == nullptr)
        ::_exit(127);
      std::vector<char*> texts = {const_cast<char*>(PRELIGHT_PROGRAM)};
      for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
      texts.push_back(nullptr);
      ::execv(texts[0], texts.data());
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    ::kill(process, signal);
    const auto sent = std::chrono::steady_clock::now();
    int status = 0;
    ::waitpid(process, &status, 0);
    secondsToEnd_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// Contents of all outputs without the time that they took.
  std::string contentOf(const std::string& output) const {
    if (draws()) return readFile(output + ".exr");
    const GlbScene scene = parseGlb(readFile(output + ".glb"));
    nlohmann::ordered_json json = scene.json;
    json.at("extensions").at("PRELIGHT_transfer").erase("seconds");
    std::string text = json.dump() + scene.bin;
    // Light maps lie beside the file and are named after it.
    for (std::size_t at = text.find(output + '.'); at != std::string::npos; at = text.find(output + '.'))
      text.replace(at, output.size(), "NAME");
    const std::string picture = output + ".lightmap.exr";
    return files().contains(picture) ? text + readFile(picture) : text;
  }

  /// Stops or kills the work once, resumes it, and compares.
  void tryOnce(double seconds, int signal, const std::string& whole) {
    SCOPED_TRACE("signal " + std::to_string(signal) + " after " + std::to_string(seconds) + " s");
    const std::set<std::string> before = files();
    const int ended = signalled(command("out", false), seconds, signal);
    if (signal == SIGKILL) {
      EXPECT_TRUE(ended == 128 + SIGKILL || ended == 0) << ended;
    } else {
      EXPECT_TRUE(ended == interrupted || ended == 0) << ended;
      EXPECT_LT(secondsToEnd_, mostSecondsToEnd) << "the stop was not answered";
    }
    if (ended != 0) {
      const ProcessResult resumed = prelight(command("out", true));
      EXPECT_EQ(resumed.exitCode, 0) << resumed.errors;
    }
    EXPECT_TRUE(contentOf("out") == whole);
    for (const std::string& name : files())
      if (name.starts_with("out.") && name.find("state") == std::string::npos)
        std::filesystem::remove(path(name));
    EXPECT_EQ(files(), before) << "something was left behind";
  }

  /// Two seconds for the program, and two for a machine that is shared.
  static constexpr double mostSecondsToEnd = 4.0;

  double secondsToEnd_ = 0.0;
};

/// Number of moments to try in all.
int stopsAskedFor() {
  const char* text = std::getenv("PRELIGHT_STOPS");
  return text != nullptr ? std::atoi(text) : 0;
}

TEST_P(StoppedWork, AtAnyMoment_IsGoneOnWithToTheSameBytes) {
  const int asked = stopsAskedFor();
  if (asked == 0 && !work().quick) GTEST_SKIP() << "PRELIGHT_STOPS tries it";
  makeScene();
  const ProcessResult done = prelightDone(command("whole", false));
  const std::string whole = contentOf("whole");
  const int share =
      asked == 0 ? 2 : (asked + static_cast<int>(works().size()) - 1) / static_cast<int>(works().size());
  std::mt19937 random(static_cast<unsigned>(97 * GetParam() + 5));
  constexpr std::array<int, 3> stops = {SIGTERM, SIGINT, SIGHUP};
  for (int i = 0; i < share; ++i) {
    const double seconds = std::uniform_real_distribution<double>(0.0, done.seconds)(random);
    tryOnce(seconds, SIGKILL, whole);
    tryOnce(std::uniform_real_distribution<double>(0.0, done.seconds)(random), stops[random() % stops.size()],
            whole);
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, StoppedWork, ::testing::Range(std::size_t{0}, works().size()));

}  // namespace
}  // namespace prelight::test
