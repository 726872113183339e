#include "sandbox/decoder.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <string_view>

#include "base/module.h"
#include "prelight/error.h"
#include "processes/channel.h"
#include "processes/child_process.h"
#include "sandbox/job_verdict.h"

namespace prelight {

namespace {

bool isSwitchedOff() {
  const char* value = std::getenv("PRELIGHT_SANDBOX");
  return value != nullptr && std::string_view(value) == "0";
}

/// The program prelight-decoder (host/decoder/decoder_main.cpp), which loads decoders once and starts a
/// process for each session. It begins with the first session, and it leaves when there is none for a while.
class Decoder {
 public:
  /// Returns the socket of a new session, or -1 where the program cannot be started.
  int connect(DecoderJob job) {
    const std::lock_guard lock(starting_);
    // The program may leave just as it is asked.
    for (int attempt = 0; attempt < 2 && !unavailable_; ++attempt) {
      if (program_ && program_->hasLeft()) program_.reset();
      if (!program_) start();
      if (!program_) return -1;
      if (const int socket = request(job); socket >= 0) return socket;
      program_.reset();
    }
    unavailable_ = true;
    return -1;
  }

 private:
  void start() {
    const std::filesystem::path path = findProgramBesideModules("prelight-decoder");
    if (!path.empty()) program_ = ChildProcess::start(path);
    unavailable_ = !program_;
  }

  /// Sends one end of a new socket. Returns the other when the session's process has said that it is there.
  int request(DecoderJob job) {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return -1;
    const bool sent = sendFile(program_->channel(), static_cast<char>(job), ends[1]);
    ::close(ends[1]);
    char ready = 0;
    if (sent && receiveBytes(ends[0], &ready, 1)) return ends[0];
    ::close(ends[0]);
    return -1;
  }

  std::mutex starting_;
  std::optional<ChildProcess> program_;
  bool unavailable_ = false;
};

/// The decoder belongs to the process as the modules do that it stands in for (base/module.h).
Decoder& decoder() {
  static Decoder decoder;
  return decoder;
}

}  // namespace

std::unique_ptr<DecoderSession> DecoderSession::begin(DecoderJob job) {
  if (isSwitchedOff()) return nullptr;
  const int socket = decoder().connect(job);
  return socket < 0 ? nullptr : std::make_unique<DecoderSession>(socket);
}

void DecoderSession::ask(const std::string& where, const std::function<void(JobSocket&)>& put,
                         const std::function<void(JobSocket&)>& get) {
  try {
    put(socket_);
    const auto verdict = socket_.get<JobVerdict>();
    if (verdict == JobVerdict::Done) return get(socket_);
    if (verdict == JobVerdict::OutOfMemory) throw std::bad_alloc();
    const auto code = socket_.get<ExitCode>();
    const std::string place = socket_.getText(), problem = socket_.getText(), fix = socket_.getText();
    if (code == ExitCode::BadInput) throw InputError(place, problem, fix);
    throw Error(code == ExitCode::OutOfMemory ? code : ExitCode::RuntimeFailure, place, problem, fix);
  } catch (const JobSocketFailure&) {
    throw InputError(where, "its decoder crashed or took more than its share of time",
                     "the data are damaged, or made to do harm");
  }
}

}  // namespace prelight
