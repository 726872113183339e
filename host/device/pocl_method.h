#pragma once

#include <string>

#include "prelight/device.h"

namespace prelight {

/// Returns the value of POCL_WORK_GROUP_METHOD that a device needs, or an empty text if the runtime's default
/// works. The default "loopvec" of PoCL 6 has LLVM verify that one round suffices to combine a kernel's
/// instructions, and LLVM aborts for kernels that need more. The method "cbs" is as fast.
std::string neededPoclMethod(const DeviceInfo& info);

/// Sets the variable to neededPoclMethod() unless it is set. PoCL reads it at every compilation.
void chooseWorkingPoclMethod(const DeviceInfo& info);

}  // namespace prelight
