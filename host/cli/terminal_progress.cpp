#include "cli/terminal_progress.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "cli/console.h"

namespace prelight::cli {
namespace {

// The one variable of the program that is not local: a signal handler can reach nothing else.
std::atomic<bool> stopSignal = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not take a lock");

void onSignal(int) { stopSignal.store(true, std::memory_order_relaxed); }

bool isTerminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

}  // namespace

void installSignalHandlers() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags =
      static_cast<int>(SA_RESETHAND) | SA_RESTART;  // the second signal does what it does by default
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void restoreSignalHandlers() {
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
}

TerminalProgress::TerminalProgress(const GlobalOptions& options)
    : enabled_(!options.quiet && isTerminal()), colored_(mayColor(STDERR_FILENO)) {}

TerminalProgress::~TerminalProgress() { clear(); }

void TerminalProgress::report(std::string_view stage, double fraction) {
  if (!enabled_) return;
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = std::chrono::steady_clock::now();
  if (stage == stage_ && now - lastDraw_ < interval && fraction < 1.0) return;
  stage_ = stage;
  lastDraw_ = now;

  constexpr int width = 30;
  const double done = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const int filled = static_cast<int>(std::lround(done * width));
  const std::string bar = std::string(static_cast<std::size_t>(filled), '=') +
                          std::string(static_cast<std::size_t>(width - filled), ' ');
  const char* begin = colored_ ? "\x1b[36m" : "";
  const char* end = colored_ ? "\x1b[0m" : "";
  fmt::print(stderr, "\r{:<16}[{}{}{}] {:3.0f} %", stage, begin, bar, end, done * 100.0);
  std::fflush(stderr);
  shown_ = true;
}

bool TerminalProgress::stopRequested() const { return stopSignal.load(std::memory_order_relaxed); }

void TerminalProgress::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r{:70}\r", "");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace prelight::cli
