#include "benchmarks/plot/python.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>

#include "benchmarks/run/measure.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

constexpr std::size_t shownOutput = 2000;  // characters of the output in an error message

/// Runs a program and writes what it prints to a file. Returns its exit code; -1 if it did not start or a
/// signal ended it.
int runProgram(const std::vector<std::string>& words, const std::string& log) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, pointers.front(), &files, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return -1;
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string pythonWith(const std::string& module) {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (runProgram({python, "-c", "import " + module}, "/dev/null") == 0) return python;
  return {};
}

std::string runScript(const std::string& python, const std::string& script,
                      const std::vector<std::string>& arguments) {
  const WorkFolder folder;
  const std::string file = folder / script, log = folder / "printed";
  std::ofstream(file, std::ios::binary) << plotScripts().at("plot/" + script);
  std::vector<std::string> words = {python, file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int code = runProgram(words, log);
  std::ifstream printed(log, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(printed), {}};
  if (code != 0)
    throw Error(ExitCode::RuntimeFailure, python + " " + script,
                fmt::format("it ended with code {}:\n{}", code,
                            text.substr(text.size() - std::min(text.size(), shownOutput))));
  return text;
}

namespace {

constexpr const char* chartLibrary = "matplotlib";

}  // namespace

bool canDrawCharts() { return !pythonWith(chartLibrary).empty(); }

std::vector<std::filesystem::path> drawCharts(const nlohmann::ordered_json& report,
                                              const std::filesystem::path& folder) {
  const WorkFolder work;
  const std::string file = work / "report.json";
  std::ofstream(file, std::ios::binary)
      << report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::istringstream printed(runScript(pythonWith(chartLibrary), "plot.py", {file, folder.string()}));
  std::vector<std::filesystem::path> files;
  for (std::string line; std::getline(printed, line);)
    if (const std::filesystem::path path = line; std::filesystem::exists(path)) files.push_back(path);
  return files;
}

}  // namespace prelight::benchmarks
