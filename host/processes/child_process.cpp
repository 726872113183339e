#include "processes/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace prelight {

namespace {

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

/// Files and signals of a process to start. It blocks signals that a terminal sends to all of its processes;
/// its parent handles them and ends it.
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

/// Starts a program. Returns -1 on failure.
pid_t spawn(const std::string& program, int channel, int errors) {
  const SpawnSettings settings(channel, errors);
  std::string name = program;
  const std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t process = -1;
  const int failure = ::posix_spawn(&process, program.c_str(), settings.files(), settings.attributes(),
                                    arguments.data(), environ);
  return failure == 0 ? process : -1;
}

}  // namespace

std::optional<ChildProcess> ChildProcess::start(const std::filesystem::path& program) {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return std::nullopt;
  ChildProcess child;
  child.channel_ = aboveStreams(ends[0]);
  int theirs = aboveStreams(ends[1]);
  child.errors_ = aboveStreams(::memfd_create(program.filename().c_str(), MFD_CLOEXEC));
  if (child.channel_ >= 0 && theirs >= 0 && child.errors_ >= 0)
    child.process_ = spawn(program, theirs, child.errors_);
  closeDescriptor(theirs);
  if (child.process_ < 0) return std::nullopt;
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      channel_(std::exchange(other.channel_, -1)),
      errors_(std::exchange(other.errors_, -1)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(channel_, other.channel_);
  std::swap(errors_, other.errors_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (process_ >= 0) ::kill(process_, SIGKILL);
  awaitEnd();
  closeDescriptor(errors_);
}

bool ChildProcess::hasLeft() const {
  pollfd left{channel_, 0, 0};
  return ::poll(&left, 1, 0) > 0;  // poll() reports a closed end even without requested events
}

int ChildProcess::awaitEnd() {
  closeDescriptor(channel_);
  if (process_ < 0) return -1;
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(process_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == std::exchange(process_, -1) ? status : -1;
}

std::string ChildProcess::errors() const {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = ::pread(errors_, part.data(), part.size(), static_cast<off_t>(text.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace prelight
