#pragma once

#include <string>
#include <vector>

#include "prelight/device.h"

namespace prelight::test {

/// All devices of all platforms, opened once. The others are compared with the first.
const std::vector<Device>& allDevices();

/// "platform, device", for messages.
std::string nameOf(const Device& device);

/// Skips the running test with a reason if there is only one device.
#define PRELIGHT_NEEDS_TWO_DEVICES()                                                                        \
  if (::prelight::test::allDevices().size() < 2)                                                            \
  GTEST_SKIP() << "only one OpenCL device (" << ::prelight::test::nameOf(::prelight::test::allDevices()[0]) \
               << "); .ci/setup.sh installs a second implementation where pip reaches a package index"

}  // namespace prelight::test
