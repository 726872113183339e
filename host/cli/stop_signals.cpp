#include "cli/stop_signals.h"

#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <unistd.h>

#include <chrono>

#include "base/error.h"

namespace prelight::cli {
namespace {

sigset_t stopSet() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
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

void StopSignals::await() {
  using Clock = std::chrono::steady_clock;
  // Programs such as timeout(1) send a signal to the process and to its group: that is one request, not two.
  constexpr auto sameRequest = std::chrono::milliseconds(500);
  const sigset_t set = stopSet();
  Clock::time_point first;
  for (;;) {
    int received = 0;
    sigwait(&set, &received);
    if (done_.load()) return;
    const bool again = requested_.exchange(true);
    if (immediate_.load() || (again && Clock::now() - first > sameRequest))
      _exit(static_cast<int>(ExitCode::Interrupted));
    if (!again) first = Clock::now();
  }
}

}  // namespace prelight::cli
