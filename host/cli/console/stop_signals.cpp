#include "cli/console/stop_signals.h"

#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <unistd.h>

#include <ctime>
#include <utility>

#include "cli/console/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Programs such as timeout(1) send a signal to the process and to its group, which counts as one request.
constexpr auto sameRequest = std::chrono::milliseconds(500);

/// The time in which work must be kept, which suffices unless a compiler or the building of a large tree is
/// in the way. Little is lost then, because saved states are at most half a minute old.
constexpr auto patience = std::chrono::milliseconds(1750);

sigset_t stopSet() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  struct sigaction hangUp {};
  if (sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
  return set;
}

/// Returns the next signal of the set, or 0 if none comes within a twentieth of a second.
int nextSignal(const sigset_t& set) {
  constexpr timespec moment{0, 50'000'000};
  return sigtimedwait(&set, nullptr, &moment);
}

}  // namespace

StopSignals::StopSignals() {
  // A shell makes its background jobs ignore SIGINT, but a signal that is sent to one of them is meant.
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

void StopSignals::setParting(std::string text) {
  const std::lock_guard lock(guard_);
  parting_ = std::move(text);
}

void StopSignals::end() {
  const std::lock_guard lock(guard_);
  const bool whole = safePoints_.load() == 0;
  if (isatty(STDERR_FILENO) == 1) writeError("\n");
  if (!parting_.empty())
    writeError(parting_ + '\n');
  else
    writeError(whole ? "prelight: interrupted; no output was written\n"
                     : "prelight: interrupted; unfinished files were not written\n");
  _exit(static_cast<int>(ExitCode::Interrupted));
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
    if (mayEnd(Clock::now() - first)) end();
    if (nextSignal(set) > 0 && !done_.load() && Clock::now() - first > sameRequest)
      _exit(static_cast<int>(ExitCode::Interrupted));
  }
}

}  // namespace prelight::cli
