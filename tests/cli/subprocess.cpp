#include "cli/subprocess.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace prelight::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Channel {
  int read = -1;
  int write = -1;
};

Channel makePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  return {ends[0], ends[1]};
}

Channel makeTerminal() {
  Channel channel;
  if (openpty(&channel.read, &channel.write, nullptr, nullptr, nullptr) != 0)
    throw std::runtime_error("openpty failed");
  fcntl(channel.read, F_SETFD, FD_CLOEXEC);
  fcntl(channel.write, F_SETFD, FD_CLOEXEC);
  return channel;
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const ProcessOptions& options,
                                const Channel& output, const Channel& errors) {
  if (!options.directory.empty() && chdir(options.directory.c_str()) != 0) _exit(127);
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(output.write, STDOUT_FILENO);
  dup2(errors.write, STDERR_FILENO);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

/// Reads both channels until the program closes them. A terminal reports the closing as an error.
void collect(pid_t process, const ProcessOptions& options, int output, int errors, ProcessResult& result) {
  std::array<pollfd, 2> channels = {{{output, POLLIN, 0}, {errors, POLLIN, 0}}};
  std::array<std::string*, 2> texts = {&result.output, &result.errors};
  bool signalled = false;
  int open = 2;
  while (open > 0 && poll(channels.data(), channels.size(), -1) > 0) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].fd < 0 || channels[i].revents == 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t count = read(channels[i].fd, buffer.data(), buffer.size());
      if (count > 0) {
        texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
      } else {
        channels[i].fd = -1;
        --open;
      }
    }
    if (options.signalAfterOutput && !signalled && !result.output.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      kill(process, *options.signalAfterOutput);
      signalled = true;
    }
  }
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& command, const ProcessOptions& options) {
  const Channel output = makePipe();
  const Channel errors = options.errorOnTerminal ? makeTerminal() : makePipe();
  const Clock::time_point start = Clock::now();
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("fork failed");
  if (process == 0) becomeProgram(command, options, output, errors);
  close(output.write);
  close(errors.write);
  ProcessResult result;
  collect(process, options, output.read, errors.read, result);
  close(output.read);
  close(errors.read);
  int status = 0;
  waitpid(process, &status, 0);
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace prelight::test
