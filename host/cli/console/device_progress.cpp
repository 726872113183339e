#include "cli/console/device_progress.h"

#include <fmt/format.h>

#include <utility>

namespace prelight::cli {

DeviceProgress::DeviceProgress(const Console& console, TerminalProgress& progress,
                               std::function<void(const std::string&)> warn)
    : console_(console), progress_(progress), warn_(std::move(warn)) {}

DeviceProgress::~DeviceProgress() {
  if (compiled_ == 0) return;
  progress_.clear();
  console_.note(fmt::format("compiled {} kernel program{} in {}", compiled_, compiled_ == 1 ? "" : "s",
                            shortSeconds(seconds_)));
}

void DeviceProgress::compiling(const KernelCompilation& program) {
  const std::lock_guard lock(telling_);
  if (!std::exchange(begun_, true) && !progress_.isVisible())
    console_.note("compiling kernels, once for each device and version");
  if (program.finished) {
    ++compiled_;
    seconds_ += program.seconds;
    progress_.clear();
  } else {
    progress_.tell(fmt::format("compiling kernels: {} of program {}, {} in all",
                               shortSeconds(program.seconds), compiled_ + 1,
                               shortSeconds(seconds_ + program.seconds)));
  }
}

void DeviceProgress::warn(std::string_view warning) {
  const std::lock_guard lock(telling_);
  if (warned_ == warning) return;
  warned_ = warning;
  warn_(warned_);
}

}  // namespace prelight::cli
