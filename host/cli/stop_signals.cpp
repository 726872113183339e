#include "cli/stop_signals.h"

#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <unistd.h>

#include <ctime>

#include "cli/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Programs such as timeout(1) send a signal to the process and to its group: that is one request, not two.
constexpr auto sameRequest = std::chrono::milliseconds(500);

/// What a safe point may keep waiting for: compilers, the building of large trees.
constexpr auto patience = std::chrono::seconds(10);

sigset_t stopSet() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

/// The next of them, or 0 when none comes within a twentieth of a second.
int nextSignal(const sigset_t& set) {
  constexpr timespec moment{0, 50'000'000};
  return sigtimedwait(&set, nullptr, &moment);
}

/// `whole`: nothing is written before the command's end.
[[noreturn]] void end(bool whole) {
  if (isatty(STDERR_FILENO) == 1) writeError("\n");
  writeError(whole ? "prelight: interrupted; no output was written\n"
                   : "prelight: interrupted; what was not finished is not written\n");
  _exit(static_cast<int>(ExitCode::Interrupted));
}

}  // namespace

StopSignals::StopSignals() {
  // A shell makes its background jobs ignore SIGINT; whoever sends it to one of them means it.
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  const sigset_t set = stopSet();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  waiter_ = std::thread(&StopSignals::await, this);
}

StopSignals::~StopSignals() {
  done_.store(true);
  pthread_kill(waiter_.native_handle(), SIGTERM);
  waiter_.join();
}

bool StopSignals::mayEnd(Clock::duration sinceRequest) const {
  return writing_.load() == 0 && (safePoints_.load() == 0 || sinceRequest > patience);
}

void StopSignals::await() {
  const sigset_t set = stopSet();
  int received = 0;
  sigwait(&set, &received);
  if (done_.load()) return;
  requested_.store(true);
  const Clock::time_point first = Clock::now();
  while (!done_.load()) {
    if (mayEnd(Clock::now() - first)) end(safePoints_.load() == 0);
    if (nextSignal(set) > 0 && !done_.load() && Clock::now() - first > sameRequest)
      _exit(static_cast<int>(ExitCode::Interrupted));
  }
}

}  // namespace prelight::cli
