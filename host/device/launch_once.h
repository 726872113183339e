#pragma once

#include <string>

#include "device/kernel.h"

namespace prelight {

/// Makes a kernel whose parameters have the arguments' types and launches it, for work that is done only
/// once. Does not wait.
template <typename... Arguments>
void launchOnce(DeviceContext& device, const std::string& file, const BuildOptions& options,
                const std::string& name, WorkSize size, const Arguments&... arguments) {
  Kernel<Arguments...>(device, file, options, name).launch(size, arguments...);
}

}  // namespace prelight
