#include "benchmarks/suites/bake/bake_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pollInterval{5};
constexpr std::size_t shownOutput = 2000;  // characters of a failure's message
constexpr int cannotStart = 127;           // as shells say it

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> argumentsOf(const BakeProcess& bake, const std::filesystem::path& report) {
  std::vector<std::string> arguments = {bake.program, "bake",     bake.scene, "-o",
                                        bake.output,  "--report", report,     "--quiet"};
  arguments.insert(arguments.end(), bake.options.begin(), bake.options.end());
  return arguments;
}

/// In the new process, where only what is safe in a signal handler may be called.
[[noreturn]] void become(char* const* arguments, const char* log) {
  if (const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC); score >= 0) {
    const ssize_t written = write(score, "1000", 4);
    if (written < 0) close(score);  // a larger share of memory's shortage is all that it changes
  }
  if (const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600); output >= 0) {
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
  }
  execv(arguments[0], arguments);
  _exit(cannotStart);
}

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const pid_t process = fork();
  if (process == 0) become(pointers.data(), log.c_str());
  if (process < 0)
    throw Error(ExitCode::RuntimeFailure, arguments.front(),
                fmt::format("cannot start it: {}", std::generic_category().message(errno)));
  return process;
}

/// The process's status at its end.
int await(pid_t process, const Progress& progress, rusage& usage) {
  int status = 0;
  bool stopped = false;
  for (;;) {
    const pid_t ended = wait4(process, &status, stopped ? 0 : WNOHANG, &usage);
    if (ended == process) break;
    if (!stopped && progress.stopRequested()) {
      kill(process, SIGTERM);
      stopped = true;
    }
    if (ended == 0) std::this_thread::sleep_for(pollInterval);
  }
  if (stopped) throw Interrupted();
  return status;
}

double secondsIn(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessCost runBakeProcess(const BakeProcess& bake, const Progress& progress) {
  const std::filesystem::path report = bake.output.string() + ".json", log = bake.output.string() + ".log";
  const std::vector<std::string> arguments = argumentsOf(bake, report);
  rusage usage{};
  const Clock::time_point begin = Clock::now();
  const int status = await(start(arguments, log), progress, usage);
  ProcessCost cost;
  cost.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  cost.processorSeconds = secondsIn(usage.ru_utime) + secondsIn(usage.ru_stime);
  cost.finished = WIFEXITED(status);
  if (!cost.finished) return cost;
  if (const int code = WEXITSTATUS(status); code != 0) {
    const std::string printed = textOf(log);
    throw Error(ExitCode::RuntimeFailure, fmt::format("{}", fmt::join(arguments, " ")),
                fmt::format("it ended with exit code {}:\n{}", code,
                            printed.substr(printed.size() - std::min(printed.size(), shownOutput))));
  }
  cost.report = nlohmann::ordered_json::parse(textOf(report));
  cost.outputBytes = std::filesystem::file_size(bake.output);
  return cost;
}

}  // namespace prelight::benchmarks
