#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "cli/console.h"
#include "cli/terminal_progress.h"
#include "prelight/progress.h"

namespace prelight::cli {

/// What devices tell during a command: that they compile kernels, by a count on a terminal, else by a line;
/// and how many they have compiled, by a line at the end. Devices may be used by several threads.
class DeviceProgress final : public Progress {
 public:
  /// `warn` is called once for each different warning.
  DeviceProgress(const Console& console, TerminalProgress& progress,
                 std::function<void(const std::string&)> warn);
  ~DeviceProgress() override;
  DeviceProgress(const DeviceProgress&) = delete;
  DeviceProgress& operator=(const DeviceProgress&) = delete;

  void report(std::string_view stage, double fraction) override { progress_.report(stage, fraction); }
  void compiling(const KernelCompilation& program) override;
  void warn(std::string_view warning) override;
  bool stopRequested() const override { return progress_.stopRequested(); }

 private:
  const Console& console_;
  TerminalProgress& progress_;
  std::function<void(const std::string&)> warn_;
  std::mutex telling_;
  std::string warned_;
  std::size_t compiled_ = 0;  ///< programs
  double seconds_ = 0.0;      ///< spent on them
  bool begun_ = false;
};

}  // namespace prelight::cli
