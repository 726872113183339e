#include "cli/console/terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cli/console/console.h"
#include "cli/console/standard_streams.h"

namespace prelight::cli {
namespace {

bool isTerminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

}  // namespace

TerminalProgress::TerminalProgress(const GlobalOptions& options, const StopSignals& signals)
    : signals_(signals), enabled_(!options.quiet && isTerminal()), colored_(mayColor(STDERR_FILENO)) {}

TerminalProgress::~TerminalProgress() { clear(); }

void TerminalProgress::report(std::string_view stage, double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(drawing_);
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
  writeError(fmt::format("\r{:<16}[{}{}{}] {:3.0f} %", stage, begin, bar, end, done * 100.0));
  shown_ = true;
}

void TerminalProgress::tell(std::string_view text) {
  if (!enabled_) return;
  const std::lock_guard lock(drawing_);
  stage_.clear();
  writeError(fmt::format("\r{:<79.79}", text));
  shown_ = true;
}

void TerminalProgress::clear() {
  const std::lock_guard lock(drawing_);
  if (!shown_) return;
  writeError(fmt::format("\r{:79}\r", ""));
  shown_ = false;
}

}  // namespace prelight::cli
