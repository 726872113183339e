#pragma once

#include <string>

#include "prelight/device.h"

namespace prelight {

/// The value of POCL_WORK_GROUP_METHOD that a device needs; empty: what the runtime chooses by itself is
/// right. PoCL 6 has LLVM verify that it combines a kernel's instructions in one round, in the method
/// "loopvec" that it chooses, and LLVM aborts on kernels of which that is not true. The method "cbs" is as
/// fast.
std::string neededPoclMethod(const DeviceInfo& info);

/// Sets the variable to that, unless it is set: PoCL reads it whenever it compiles.
void chooseWorkingPoclMethod(const DeviceInfo& info);

}  // namespace prelight
