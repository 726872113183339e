#include "device/compiler_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "base/module.h"
#include "device/compile_channel.h"
#include "device/opencl_devices.h"

namespace prelight {

namespace {

constexpr int pause = 100;  ///< ms between two calls of `goOn`
constexpr std::size_t longestQuote = 300;

void closeDescriptor(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

/// Returns a duplicate of a descriptor above those of the standard streams: a program may have been started
/// without these.
int aboveStreams(int descriptor) {
  if (descriptor < 0 || descriptor > STDERR_FILENO) return descriptor;
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(descriptor);
  return moved;
}

std::string readFromStart(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = ::pread(file, part.data(), part.size(), static_cast<off_t>(text.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// Returns the line of a compiler's output that describes the error, else the last line.
std::string tellingLine(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    last = line.substr(0, longestQuote);
    if (line.find("ERROR") != std::string::npos || line.find("Assertion") != std::string::npos) break;
  }
  return last;
}

std::string wayOut(int status) {
  if (WIFEXITED(status)) return fmt::format("it ended with code {}", WEXITSTATUS(status));
  const char* name = WIFSIGNALED(status) ? sigdescr_np(WTERMSIG(status)) : nullptr;
  return name != nullptr ? fmt::format("it ended by signal {}, {}", WTERMSIG(status), name) : "it ended";
}

/// Waits for a process and returns its status, or -1 if another part of the program has already collected it.
int awaitEnd(pid_t process) {
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(process, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == process ? status : -1;
}

/// Files and signals of a process to start. The compiler blocks signals that a terminal sends to all of its
/// processes; its parent handles them and ends it.
class SpawnSettings {
 public:
  SpawnSettings(int channel, int errors) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, channel, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, errors, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t blocked;
    sigemptyset(&blocked);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&blocked, number);
    posix_spawnattr_setsigmask(&attributes_, &blocked);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  const posix_spawn_file_actions_t* files() const { return &files_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

CompilerProcess::CompilerProcess(const DeviceInfo& device) : device_(nameForCompiler(device)) {}

CompilerProcess::~CompilerProcess() { end(); }

CompileAnswer CompilerProcess::compile(const CompileJob& job, const std::function<bool()>& goOn) {
  for (;;) {
    if (hasLeft()) end();
    const bool anew = process_ < 0;
    if (anew && !start(goOn)) return giveUp();
    std::string answer;
    if (exchange(job, goOn, answer)) {
      const auto verdict = static_cast<CompileVerdict>(answer.front());
      answer.erase(0, 1);
      return {verdict == CompileVerdict::Built ? CompileAnswer::Kind::Built : CompileAnswer::Kind::Refused,
              std::move(answer)};
    }
    if (stopped_) return giveUp();
    const CompileAnswer death = tellDeath();
    // Otherwise the process left just as the job was sent.
    if (anew || death.kind != CompileAnswer::Kind::Unavailable) return death;
  }
}

bool CompilerProcess::hasLeft() const {
  if (process_ < 0) return false;
  pollfd left{channel_, 0, 0};
  return ::poll(&left, 1, 0) > 0;  // poll() reports a closed end even without requested events
}

bool CompilerProcess::exchange(const CompileJob& job, const std::function<bool()>& goOn,
                               std::string& answer) {
  busy_ = true;
  if (!sendText(channel_, job.options) || !sendText(channel_, job.source) || !await(goOn, answer) ||
      answer.empty())
    return false;
  busy_ = false;
  return true;
}

/// Starts the process. After a failure it is not tried again, and the caller compiles by itself.
bool CompilerProcess::start(const std::function<bool()>& goOn) {
  if (unavailable_) return false;
  unavailable_ = true;
  const std::filesystem::path program = findProgramBesideModules("prelight-compiler");
  std::array<int, 2> ends{-1, -1};
  if (program.empty() || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
  channel_ = aboveStreams(ends[0]);
  int theirs = aboveStreams(ends[1]);
  errors_ = aboveStreams(::memfd_create("prelight-compiler", MFD_CLOEXEC));
  const bool spawned = channel_ >= 0 && theirs >= 0 && errors_ >= 0 && spawn(program, theirs, errors_);
  closeDescriptor(theirs);
  std::string refusal;
  if (!spawned || !sendText(channel_, device_)) return false;
  busy_ = true;
  if (!await(goOn, refusal) || !refusal.empty()) return false;
  unavailable_ = busy_ = false;
  return true;
}

bool CompilerProcess::spawn(const std::string& program, int channel, int errors) {
  const SpawnSettings settings(channel, errors);
  std::string name = program;
  const std::array<char*, 2> arguments{name.data(), nullptr};
  const int failure = ::posix_spawn(&process_, program.c_str(), settings.files(), settings.attributes(),
                                    arguments.data(), environ);
  if (failure != 0) process_ = -1;
  return failure == 0;
}

bool CompilerProcess::await(const std::function<bool()>& goOn, std::string& text) {
  pollfd answer{channel_, POLLIN, 0};
  for (;;) {
    const int ready = ::poll(&answer, 1, pause);
    if (ready < 0 && errno != EINTR) return false;
    if (ready > 0) break;
    if (goOn()) continue;
    stopped_ = true;
    return false;
  }
  std::optional<std::string> received = receiveText(channel_);
  if (!received) return false;
  text = std::move(*received);
  return true;
}

CompileAnswer CompilerProcess::giveUp() {
  end();
  if (!stopped_) return {CompileAnswer::Kind::Unavailable, {}};
  stopped_ = unavailable_ = false;
  return {CompileAnswer::Kind::Stopped, {}};
}

CompileAnswer CompilerProcess::tellDeath() {
  closeDescriptor(channel_);  // ends the process if it still lives
  const int status = awaitEnd(process_);
  process_ = -1;
  const std::string words = tellingLine(readFromStart(errors_));
  end();
  if (status == 0) return {CompileAnswer::Kind::Unavailable, {}};
  if (status >= 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    return {CompileAnswer::Kind::Killed, {}};
  return {CompileAnswer::Kind::Died, wayOut(status) + (words.empty() ? "" : ": " + words)};
}

void CompilerProcess::end() {
  closeDescriptor(channel_);  // the process ends when it reads the end of the channel
  if (process_ >= 0) {
    if (busy_) ::kill(process_, SIGKILL);
    awaitEnd(process_);
  }
  process_ = -1;
  busy_ = false;
  closeDescriptor(errors_);
}

}  // namespace prelight
