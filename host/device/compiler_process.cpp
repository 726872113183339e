#include "device/compiler_process.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <sstream>
#include <utility>

#include "base/module.h"
#include "device/compile_channel.h"
#include "device/opencl_devices.h"
#include "processes/channel.h"

namespace prelight {

namespace {

constexpr int pause = 100;  ///< ms between two calls of `goOn`
constexpr std::size_t longestQuote = 300;

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

}  // namespace

CompilerProcess::CompilerProcess(const DeviceInfo& device) : device_(nameForCompiler(device)) {}

CompileAnswer CompilerProcess::compile(const CompileJob& job, const std::function<bool()>& goOn) {
  for (;;) {
    if (process_ && process_->hasLeft()) process_.reset();
    const bool anew = !process_;
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

bool CompilerProcess::exchange(const CompileJob& job, const std::function<bool()>& goOn,
                               std::string& answer) {
  const int channel = process_->channel();
  return sendText(channel, job.options) && sendText(channel, job.source) && await(goOn, answer) &&
         !answer.empty();
}

/// Starts the process. After a failure it is not tried again, and the caller compiles by itself.
bool CompilerProcess::start(const std::function<bool()>& goOn) {
  if (unavailable_) return false;
  unavailable_ = true;
  const std::filesystem::path program = findProgramBesideModules("prelight-compiler");
  if (program.empty()) return false;
  process_ = ChildProcess::start(program);
  std::string refusal;
  if (!process_ || !sendText(process_->channel(), device_) || !await(goOn, refusal) || !refusal.empty())
    return false;
  unavailable_ = false;
  return true;
}

bool CompilerProcess::await(const std::function<bool()>& goOn, std::string& text) {
  while (!awaitData(process_->channel(), pause)) {
    if (goOn()) continue;
    stopped_ = true;
    return false;
  }
  std::optional<std::string> received = receiveText(process_->channel());
  if (!received) return false;
  text = std::move(*received);
  return true;
}

CompileAnswer CompilerProcess::giveUp() {
  process_.reset();
  if (!stopped_) return {CompileAnswer::Kind::Unavailable, {}};
  stopped_ = unavailable_ = false;
  return {CompileAnswer::Kind::Stopped, {}};
}

CompileAnswer CompilerProcess::tellDeath() {
  const int status = process_->awaitEnd();
  const std::string words = tellingLine(process_->errors());
  process_.reset();
  if (status == 0) return {CompileAnswer::Kind::Unavailable, {}};
  if (status >= 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    return {CompileAnswer::Kind::Killed, {}};
  return {CompileAnswer::Kind::Died, wayOut(status) + (words.empty() ? "" : ": " + words)};
}

}  // namespace prelight
