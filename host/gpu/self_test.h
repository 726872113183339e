#pragma once

#include <string>
#include <vector>

#include "prelight/device.h"

namespace prelight {

/// One line of `prelight devices --test`.
struct SelfTestResult {
  std::string name;
  bool passed = false;
  std::string detail;
};

/// Runs the device's self-test: kernels build, struct layouts agree, rays hit what they must, sums agree with
/// the host. Never throws; failures are results.
std::vector<SelfTestResult> selfTest(const Device& device);

}  // namespace prelight
