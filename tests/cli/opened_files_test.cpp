// The program opens the files of a scene, its own outputs and caches, and the system's files. strace shows
// that it opens nothing else beside or above a scene, whatever the scene names.
#include <gmock/gmock.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A file that a process has opened or changed, or a place that it has connected to.
struct Access {
  std::string path;
  bool writes = false;
  std::string line;  ///< of strace
};

bool lies(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder + "/");
}

/// Returns the successful calls of a log of `strace -f -y -e trace=%file` of a program in a folder. Calls
/// whose result stands in another line count as successful.
std::vector<Access> accessesOf(const std::string& log, const fs::path& folder) {
  const std::regex call(R"re((\w+)\((.*)$)re"),
      place(R"re((?:(?:AT_FDCWD|\d+)<([^>]*)>, )?"([^"]*)"([^"]*))re"), refused(R"(= -1 E[A-Z]+ )");
  std::vector<Access> accesses;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::smatch parts;
    if (std::regex_search(line, refused) || !std::regex_search(line, parts, call)) continue;
    const std::string name = parts[1], arguments = parts[2];
    const bool opens = name.starts_with("open") || name == "creat" || name == "execve";
    const bool changes = name.starts_with("rename") || name.starts_with("unlink") ||
                         name.starts_with("mkdir") || name.starts_with("link") ||
                         name.starts_with("symlink") || name == "truncate";
    if (!opens && !changes) continue;
    for (std::sregex_iterator at(arguments.begin(), arguments.end(), place), end; at != end; ++at) {
      const std::string flags = (*at)[3];
      const bool writes = changes || flags.find("O_WRONLY") != std::string::npos ||
                          flags.find("O_RDWR") != std::string::npos ||
                          flags.find("O_CREAT") != std::string::npos;
      accesses.push_back(
          {(folder / (*at)[1].str() / (*at)[2].str()).lexically_normal().string(), writes, line});
      if (opens) break;  // further texts are arguments of the program that is started
    }
  }
  return accesses;
}

class CliOpenedFiles : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    for (const char* name : {"scene", "out", "caches", "spill"}) fs::create_directory(path(name));
    const ProcessResult tried = runProcess({"strace", "-o", path("tried").string(), "true"});
    if (tried.exitCode != 0) GTEST_SKIP() << "strace is missing or may not trace: " << tried.errors;
    writeFile("secret.bin", std::string(108, 's'));
    writeFile("scene/data.bin", floorAndRoof().bin);
  }

  /// A scene whose geometry, or another buffer, lies at `uri`.
  void writeScene(const std::string& uri) const {
    GlbScene scene = floorAndRoof();
    scene.json["buffers"][0]["uri"] = uri;
    writeFile("scene/scene.gltf", scene.json.dump());
  }

  ProcessResult traced(const std::vector<std::string>& arguments, std::vector<Access>& accesses) const {
    const fs::path log = path("spill") / "trace";
    std::vector<std::string> words = {
        "strace", "-f", "-qq", "-y", "-s", "4096", "-e", "trace=%file,connect", "-o", log, PRELIGHT_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const ProcessResult result =
        runProcess(words, {.directory = path(""),
                           .environment = {{"HOME", path("caches").string()},
                                           {"XDG_CACHE_HOME", path("caches").string()},
                                           {"POCL_CACHE_DIR", path("caches").string()},
                                           {"TMPDIR", path("spill").string()}}});
    accesses = accessesOf(readFile("spill/trace"), path(""));
    EXPECT_GT(accesses.size(), 10u) << result.errors;
    return result;
  }

  /// Everything below the test's folder that is not the scene's, an output or a cache is nobody's business.
  void expectOwn(const std::vector<Access>& accesses) const {
    for (const Access& access : accesses) {
      const bool system = !lies(access.path, path("").parent_path().string());
      const bool own = lies(access.path, path("out").string()) ||
                       lies(access.path, path("caches").string()) ||
                       lies(access.path, path("spill").string());
      if (system)
        EXPECT_TRUE(!access.writes || lies(access.path, "/dev") || lies(access.path, "/proc")) << access.line;
      else
        EXPECT_TRUE(own || access.path + "/" == path("").string() ||
                    (!access.writes && lies(access.path, path("scene").string())))
            << access.line;
    }
  }
};

TEST_F(CliOpenedFiles, EveryCommand_OpensTheScenesFilesAndItsOwnAlone) {
  writeScene("data.bin");
  std::vector<Access> accesses;
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"info", "scene/scene.gltf"},
           {"bake", "scene/scene.gltf", "-o", "out/baked.glb", "--ao", "--rays", "16"},
           {"reference", "scene/scene.gltf", "-o", "out/truth.exr", "--size", "8x8", "--spp", "1"},
           {"export", "out/baked.glb", "-o", "out/page.html", "--target", "web"}}) {
    SCOPED_TRACE(command.front());
    const ProcessResult result = traced(command, accesses);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    expectOwn(accesses);
  }
}

TEST_F(CliOpenedFiles, SceneThatNamesOthersFiles_DoesNotOpenThem) {
  fs::create_symlink("../secret.bin", path("scene/link.bin"));
  const std::string secret = path("secret.bin").string();
  std::vector<Access> accesses;
  for (const std::string& uri :
       {std::string("../secret.bin"), secret, "file://" + secret, std::string("link.bin"),
        std::string("%2e%2e/secret.bin"), std::string("data.bin/../../secret.bin")}) {
    SCOPED_TRACE(uri);
    writeScene(uri);
    const ProcessResult result = traced({"info", "scene/scene.gltf"}, accesses);
    EXPECT_EQ(result.exitCode, badInput) << result.errors;
    expectOwn(accesses);
    for (const Access& access : accesses)
      EXPECT_FALSE(fs::exists(access.path) && fs::exists(secret) && fs::equivalent(access.path, secret))
          << access.line;
  }
}

}  // namespace
}  // namespace prelight::test
