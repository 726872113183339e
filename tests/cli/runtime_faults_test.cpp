#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;

constexpr int noDevice = 4;

/// Commands with a broken OpenCL or OpenGL. No kernel is cached.
class CliRuntimeFaults : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
    writeFile("file", "not a folder");
    std::string pattern = (std::filesystem::temp_directory_path() / "prelight-cold-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    cache_ = pattern;
  }
  void TearDown() override {
    std::filesystem::remove_all(cache_);
    CliTest::TearDown();
  }

  /// Environment of a user with empty caches, and the variables `added` to it.
  ProcessOptions cold(std::map<std::string, std::string> added = {}) const {
    added.emplace("XDG_CACHE_HOME", cache_);
    return {.environment = std::move(added)};
  }

  /// Environment with empty caches, and with a compiler or threads that fail as faulty_runtime.cpp says.
  ProcessOptions faulty(const std::string& fault, const std::string& value) const {
    return cold({{"LD_PRELOAD", FAULTY_RUNTIME}, {fault, value}});
  }

  /// Number of temporary folders that replace PoCL's cache.
  static std::size_t temporaryFolders(const std::filesystem::path& in) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(in))
      count += entry.path().filename().string().starts_with("prelight-pocl-") ? 1 : 0;
    return count;
  }

  /// Number of times that PoCL has compiled each kernel, by the kernel's folder in PoCL's cache.
  std::map<std::string, int> timesCompiled() const {
    std::map<std::string, int> times;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache_))
      if (entry.path().extension() == ".so") ++times[entry.path().parent_path().parent_path()];
    return times;
  }

  const std::vector<std::string> bake_{"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "16"};

  std::vector<std::string> quietBake() const {
    std::vector<std::string> arguments = bake_;
    arguments.emplace_back("--quiet");
    return arguments;
  }

 private:
  std::filesystem::path cache_;
};

TEST_F(CliRuntimeFaults, FirstRun_SaysThatKernelsAreCompiled_TheSecondDoesNot) {
  prelightDone(
      {"scene", "shapes", "-o", "shapes.glb"});  // whose triangles are small enough to say nothing of
  const std::vector<std::string> bake{"bake", "shapes.glb", "-o", "out.glb", "--ao", "--rays", "16"};
  const ProcessResult first = prelightDone(bake, cold());
  EXPECT_THAT(first.errors, HasSubstr("prelight: compiling kernels"));
  EXPECT_THAT(first.errors, MatchesRegex("(.|\n)*prelight: compiled [0-9]+ kernel programs in [0-9.]+ s\n"));
  EXPECT_THAT(first.errors, Not(HasSubstr("warning"))) << "those of the compiler concern nobody";
  EXPECT_THAT(prelightDone(bake, cold()).errors, IsEmpty());
}

TEST_F(CliRuntimeFaults, FirstRun_CompilesEachKernelOnce) {
  prelightDone(quietBake(), cold());
  const std::map<std::string, int> times = timesCompiled();
  if (times.empty()) GTEST_SKIP() << "the device is not PoCL's";
  for (const auto& [kernel, count] : times) EXPECT_EQ(count, 1) << kernel;
}

TEST_F(CliRuntimeFaults, FirstRun_WithQuiet_WritesNothing) {
  const ProcessResult result = prelightDone(quietBake(), cold());
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.output, IsEmpty());
}

TEST_F(CliRuntimeFaults, FirstRun_OnATerminal_CountsProgramsAndSeconds) {
  ProcessOptions options = cold({{"TERM", "xterm"}});
  options.errorOnTerminal = true;
  const ProcessResult result = prelightDone(bake_, options);
  EXPECT_THAT(result.errors, HasSubstr("compiling kernels: "));
  EXPECT_THAT(result.errors, HasSubstr("of program 2, "));
  EXPECT_THAT(result.errors, HasSubstr("prelight: compiled "));
}

TEST_F(CliRuntimeFaults, CompilerThatCrashes_EndsWithOneErrorAndNoOutput) {
  expectFailure(failed, quietBake(),
                {"_kernels.cl: the compiler of ", "LLVM ERROR: made up by a test", "--device"},
                faulty("FAULT_COMPILER", "crash"));
}

/// A picture of one pixel.
const std::string png(
    "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\001\000\000\000\001\010"
    "\006\000\000\000\037\025\304\211\000\000\000\015\111\104\101\124\170\332\143\144\370\317\120\017\000"
    "\003\206\001\200\132\064\175\153\000\000\000\000\111\105\116\104\256\102\140\202",
    70);

TEST_F(CliRuntimeFaults, DecoderThatCrashes_IsAnErrorOfTheFileAndEndsNothingElse) {
  writeFile("a.png", png);
  const std::vector<std::string> compare{"compare", "a.png", "a.png"};
  ProcessOptions crash{.environment = {{"LD_PRELOAD", FAULTY_RUNTIME}, {"FAULT_DECODER", "crash"}}};
  expectFailure(badInput, compare, {"a.png: its decoder crashed", "damaged"}, crash);
  crash.environment["PRELIGHT_SANDBOX"] = "0";
  EXPECT_NE(prelight(compare, crash).exitCode, badInput) << "the decoder is a part of the command then";
}

TEST_F(CliRuntimeFaults, CompilerThatIsKilled_IsOutOfMemory) {
  expectFailure(outOfMemory, quietBake(), {"was killed"}, faulty("FAULT_COMPILER", "kill"));
}

TEST_F(CliRuntimeFaults, Stop_WhileACompilerHangs_IsAnsweredSoon) {
  ProcessOptions options = faulty("FAULT_COMPILER", "hang");
  options.signalAfterOutput = SIGTERM;  // The scene's line is printed before kernels are requested.
  const ProcessResult result = prelight(bake_, options);
  EXPECT_EQ(result.exitCode, interrupted) << result.errors;
  EXPECT_LT(result.seconds, 8.0) << "without a compiler of its own the program waits for ten";
}

TEST_F(CliRuntimeFaults, PoclCacheThatTakesNothing_IsReplacedWithAWarning) {
  ASSERT_EQ(mkdir(path("tmp").c_str(), 0700), 0);
  for (const std::string& folder :
       {std::string("/proc/nope"), path("file").string(), path("file/below").string()}) {
    const ProcessOptions options = cold({{"POCL_CACHE_DIR", folder}, {"TMPDIR", path("tmp")}});
    const ProcessResult result = prelightDone({"devices"}, options);
    EXPECT_THAT(result.errors,
                AllOf(HasSubstr("warning: "), HasSubstr(folder), HasSubstr("set POCL_CACHE_DIR")));
    EXPECT_THAT(prelightDone({"devices", "--quiet"}, options).errors, IsEmpty());
    EXPECT_EQ(temporaryFolders(path("tmp")), 0u) << folder;
  }
}

TEST_F(CliRuntimeFaults, HomeThatTakesNothing_CompilesAndBakesAllTheSame) {
  ASSERT_EQ(mkdir(path("tmp").c_str(), 0700), 0);
  const ProcessOptions options{
      .environment = {{"HOME", "/proc"}, {"XDG_CACHE_HOME", ""}, {"TMPDIR", path("tmp")}}};
  const ProcessResult result = prelightDone(bake_, options);
  EXPECT_THAT(result.errors, HasSubstr("/proc/.cache/pocl/kcache"));
  EXPECT_EQ(temporaryFolders(path("tmp")), 0u);
  const std::string baked = readFile("out.glb");
  prelightDone(bake_);
  const GlbScene expected = parseGlb(readFile("out.glb"));
  EXPECT_EQ(parseGlb(baked).bin, expected.bin);
}

TEST_F(CliRuntimeFaults, FolderThatAKilledProcessLeft_IsRemoved) {
  for (const char* name : {"tmp", "tmp/prelight-pocl-aaaaaa", "tmp/other"})
    ASSERT_EQ(mkdir(path(name).c_str(), 0700), 0);
  writeFile("tmp/prelight-pocl-aaaaaa/lock", "");
  prelightDone({"devices"}, cold({{"POCL_CACHE_DIR", "/proc/nope"}, {"TMPDIR", path("tmp")}}));
  EXPECT_EQ(temporaryFolders(path("tmp")), 0u);
  EXPECT_TRUE(std::filesystem::exists(path("tmp/other")));
}

TEST_F(CliRuntimeFaults, ThreadsThatCannotBeHad_AreOutOfMemory) {
  // The first thread is the program's own. The program tries the later ones before the runtime starts
  // threads.
  for (const char* from : {"1", "2", "3"})
    expectFailure(outOfMemory, {"devices"}, {}, faulty("FAULT_THREAD", from));
  expectFailure(outOfMemory, {"devices"}, {"ulimit -u"}, faulty("FAULT_THREAD", "2"));
}

#ifdef PRELIGHT_WITH_VIEWER
TEST_F(CliRuntimeFaults, LibraryOfOpenGlThatIsMissing_IsNoDeviceAndNamesThePackage) {
  ASSERT_EQ(mkdir(path("gl").c_str(), 0700), 0);
  const std::vector<std::string> render{"render", "scene.glb", "-o",    "out.png", "--shading",
                                        "phong",  "--size",    "32x32", "--quiet"};
  const ProcessOptions options{.environment = {{"LD_LIBRARY_PATH", path("gl")}}};
  // A file that is no library stands in for a missing one: the search ends with it.
  writeFile("gl/libEGL.so.1", "");
  expectFailure(noDevice, render, {"OpenGL: ", "libEGL.so.1", "apt install libegl1"}, options);
  expectFailure(noDevice, {"bake", "scene.glb", "-o", "out.glb", "--sh", "2", "--visibility", "raster"},
                {"OpenGL: ", "libEGL.so.1", "apt install libegl1"}, options);
  std::filesystem::remove(path("gl/libEGL.so.1"));
  writeFile("gl/libGL.so.1", "");
  writeFile("gl/libOpenGL.so.0", "");
  expectFailure(noDevice, render, {"OpenGL: ", "libGL.so.1", "apt install libgl1"}, options);
}
#endif

}  // namespace
}  // namespace prelight::test
