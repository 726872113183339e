#include "device/pocl_method.h"

#include <cstdlib>
#include <mutex>

namespace prelight {

std::string neededPoclMethod(const DeviceInfo& info) {
  return info.isPocl && info.driverVersion.starts_with("6.") ? "cbs" : "";
}

void chooseWorkingPoclMethod(const DeviceInfo& info) {
  static std::mutex setting;
  const std::lock_guard lock(setting);
  const std::string method = neededPoclMethod(info);
  if (!method.empty()) ::setenv("POCL_WORK_GROUP_METHOD", method.c_str(), 0);
}

}  // namespace prelight
