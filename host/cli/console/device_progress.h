#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "cli/console/console.h"
#include "cli/console/terminal_progress.h"
#include "prelight/progress.h"

namespace prelight::cli {

/// Tells people that devices compile kernels, by a counter on a terminal and by a line elsewhere, and at the
/// end how many were compiled. Several threads may use the devices.
class DeviceProgress final : public Progress {
 public:
  /// `warn` is called once for every different warning.
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
  std::size_t compiled_ = 0;  ///< number of compiled programs
  double seconds_ = 0.0;      ///< time spent on compiling them
  bool begun_ = false;
};

}  // namespace prelight::cli
