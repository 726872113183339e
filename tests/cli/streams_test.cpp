#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Destinations of messages and results, and inputs other than files.
class CliStreams : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  /// Runs a script in which $P is the program.
  ProcessResult shell(const std::string& script) const {
    return runProcess({"/bin/bash", "-c", script},
                      {.directory = path(""), .environment = {{"P", PRELIGHT_PROGRAM}}});
  }
};

TEST_F(CliStreams, Stdout_OnAFullDevice_IsAFailureWithAMessage) {
  for (const char* command : {"info scene.glb", "info scene.glb --json", "scene --list", "--help",
                              "--version", "devices", "scene shapes -o shapes.glb"}) {
    const ProcessResult result = shell(std::string("$P ") + command + " > /dev/full");
    EXPECT_EQ(result.exitCode, failed) << command;
    EXPECT_THAT(result.errors, HasSubstr("error: stdout: ")) << command;
  }
  EXPECT_EQ(shell("$P info scene.glb --quiet > /dev/full").exitCode, 0) << "nothing is lost";
}

TEST_F(CliStreams, Stderr_ThatTakesNothing_LeavesTheExitCode) {
  EXPECT_EQ(shell("$P info none.glb 2> /dev/full").exitCode, badInput);
  EXPECT_EQ(shell("$P info none.glb 2>&-").exitCode, badInput);
  EXPECT_EQ(shell("$P nothing 2> /dev/full").exitCode, 2);
  EXPECT_EQ(shell("$P scene shapes -o nowhere/a.glb 2>&-").exitCode, failed);
}

TEST_F(CliStreams, AllClosed_NoFileIsTakenForThem) {
  EXPECT_EQ(shell("$P scene shapes -o shapes.glb <&- >&- 2>&-").exitCode, failed);
  EXPECT_EQ(shell("$P scene shapes -o other.glb").exitCode, 0);
  EXPECT_EQ(readFile("shapes.glb"), readFile("other.glb"));
  EXPECT_EQ(shell("$P info scene.glb >&-").exitCode, failed);
  EXPECT_EQ(shell("$P info scene.glb <&-").exitCode, 0);
}

TEST_F(CliStreams, Pipe_WhoseReaderHasGone_IsNoFailure) {
  const ProcessResult result = shell("{ sleep 0.3; $P info scene.glb; echo $? > code; } | true");
  EXPECT_EQ(readFile("code"), "0\n") << result.errors;
}

TEST_F(CliStreams, Pipe_AsInput_IsRefusedAtOnce) {
  for (const char* name : {"a.glb", "a.gltf", "a.hdr", "a.exr", "out.glb.state"})
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
  for (const char* command :
       {"info a.glb", "info a.gltf", "bake a.glb -o out.glb",
        "bake scene.glb -o new.glb --lightmap --env a.hdr", "compare a.exr a.exr", "compare a.glb a.glb",
        "bake scene.glb -o out.glb --ao --rays 16 --resume", "info /dev/zero"}) {
    const ProcessResult result = shell(std::string("timeout -k 1 60 $P ") + command);
    EXPECT_EQ(result.exitCode, badInput) << command << "\n" << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("file")) << command;
  }
}

TEST_F(CliStreams, Pipe_AsOutput_IsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path("out.glb").c_str(), 0600), 0);
  ASSERT_EQ(symlink("/dev/full", path("full.glb").c_str()), 0);
  for (const char* name : {"out.glb", "full.glb"}) {
    const ProcessResult result = shell(std::string("timeout -k 1 60 $P bake scene.glb --ao -o ") + name);
    EXPECT_EQ(result.exitCode, failed) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("not a regular file"));
  }
}

/// Names contain terminal control sequences, of which no byte may reach the terminal.
TEST_F(CliStreams, Names_ThatCommandATerminal_AreShownHarmless) {
  GlbScene scene = floorAndRoof();
  const std::string name =
      "\x1b]0;owned\x07\x1b[31m\xc2\x9b"
      "2J\xe2\x80\xae\x7f";
  scene.json["cameras"][0]["name"] = name;
  scene.json["nodes"][0]["name"] = name;
  scene.json["materials"][0]["name"] = name;
  writeFile("names.glb", scene.bytes());
  for (const char* option : {"", "--json", "--verbose"}) {
    const ProcessResult result = shell(std::string("$P info names.glb ") + option);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    for (const char* control : {"\x1b", "\x07", "\xc2\x9b", "\xe2\x80\xae", "\x7f"}) {
      EXPECT_THAT(result.output, Not(HasSubstr(control))) << option;
      EXPECT_THAT(result.errors, Not(HasSubstr(control))) << option;
    }
    EXPECT_THAT(result.output, HasSubstr("\\u001b]0;owned\\u0007")) << option;
  }
  const ProcessResult missing = prelight({"info", "a\x1b[31m\nprelight: b\x9b.glb"});
  EXPECT_EQ(missing.exitCode, badInput);
  EXPECT_THAT(missing.errors, HasSubstr("\\u001b[31m"));
  EXPECT_THAT(missing.errors, HasSubstr("\\x9b"));
  EXPECT_THAT(missing.errors, Not(HasSubstr("\nprelight: b")));
}

TEST_F(CliStreams, Output_OfALongName_IsWritten) {
  const std::string name = std::string(240, 'n') + ".glb";
  prelightDone({"scene", "shapes", "-o", name});
  EXPECT_EQ(files(), (std::set<std::string>{"scene.glb", name}));
  expectFailure(failed, {"bake", "scene.glb", "-o", std::string(252, 'n') + ".glb"}, {"-o n", "name"});
  expectFailure(failed, {"bake", "scene.glb", "--lightmap", "-o", std::string(250, 'n') + ".glb"},
                {"-o n", "name"});
}

TEST_F(CliStreams, Output_ThroughALinkToNothing_MakesItsTarget) {
  ASSERT_EQ(symlink("target.glb", path("link.glb").c_str()), 0);
  prelightDone({"scene", "shapes", "-o", "link.glb"});
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.glb")));
  EXPECT_TRUE(std::filesystem::is_regular_file(path("target.glb")));
}

TEST_F(CliStreams, Output_OnAFullDisk_KeepsTheOlderFile) {
  prelightDone({"scene", "cornell", "-o", "out.glb"});
  const std::string before = readFile("out.glb");
  const std::set<std::string> names = files();
  const ProcessResult result = shell("ulimit -f 8; $P scene rooms -o out.glb");
  EXPECT_EQ(result.exitCode, failed);
  EXPECT_THAT(result.errors, HasSubstr("cannot write"));
  EXPECT_EQ(readFile("out.glb"), before);
  EXPECT_EQ(files(), names);
}

TEST_F(CliStreams, Stack_ThatIsSmall_IsNoMatter) {
  const ProcessResult result =
      shell("ulimit -s 64; $P bake scene.glb -o out.glb --ao --sh 3 --bounces 1 --rays 16");
  EXPECT_EQ(result.exitCode, 0) << result.errors;
}

/// Too little memory for the kernel compiler, and for the libraries of pictures.
TEST_F(CliStreams, AddressSpace_TooSmall_IsOutOfMemory) {
  for (const char* kilobytes : {"150000", "250000"}) {
    const ProcessResult result = shell(std::string("ulimit -v ") + kilobytes +
                                       "; $P bake scene.glb -o out.glb --ao --sh 3 --bounces 1 --rays 16");
    EXPECT_EQ(result.exitCode, outOfMemory) << kilobytes << "\n" << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("error: ")) << kilobytes;
  }
  EXPECT_EQ(files(), (std::set<std::string>{"scene.glb"}));
}

/// A fresh cache makes the self-test compile for longer than the signal takes to arrive.
TEST_F(CliStreams, Signal_WhereNothingHasToBeFinished_EndsTheProgramAtOnce) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const ProcessResult result =
        prelight({"devices", "--test"}, {.environment = {{"POCL_CACHE_DIR", path("pocl").string()},
                                                         {"XDG_CACHE_HOME", path("cache").string()}},
                                         .signalAfterOutput = signal});
    EXPECT_EQ(result.exitCode, interrupted) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("interrupted"));
    std::filesystem::remove_all(path("pocl"));
    std::filesystem::remove_all(path("cache"));
  }
}

}  // namespace
}  // namespace prelight::test
