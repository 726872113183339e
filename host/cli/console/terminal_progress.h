#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "cli/console/global_options.h"
#include "cli/console/stop_signals.h"
#include "prelight/progress.h"

namespace prelight::cli {

/// A bar on stderr if that is a terminal and --quiet is not given. It knows whether the user has asked to
/// stop.
class TerminalProgress final : public Progress {
 public:
  TerminalProgress(const GlobalOptions& options, const StopSignals& signals);
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// False if nothing is ever drawn.
  bool isVisible() const { return enabled_; }

  void report(std::string_view stage, double fraction) override;

  /// Shows a text instead of the bar.
  void tell(std::string_view text);
  bool stopRequested() const override { return signals_.stopRequested(); }

  /// Removes the bar, so that text can follow.
  void clear();

 private:
  const StopSignals& signals_;
  bool enabled_;
  bool colored_;
  bool shown_ = false;
  std::mutex drawing_;  ///< devices report from threads of their own
  std::string stage_;
  std::chrono::steady_clock::time_point lastDraw_;
};

}  // namespace prelight::cli
