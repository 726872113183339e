#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "cli/global_options.h"

namespace prelight::cli {

/// Installs handlers by which the first SIGINT or SIGTERM asks the work to stop and a second one ends the
/// process.
void installSignalHandlers();

/// Lets the first signal end the process again.
void restoreSignalHandlers();

/// A bar on stderr when that is a terminal and --quiet is not given; knows when the user has asked to stop.
class TerminalProgress final : public Progress {
 public:
  explicit TerminalProgress(const GlobalOptions& options);
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void report(std::string_view stage, double fraction) override;
  bool stopRequested() const override;

  /// Takes the bar away, so that text can follow.
  void clear();

 private:
  bool enabled_;
  bool colored_;
  bool shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point lastDraw_;
};

}  // namespace prelight::cli
