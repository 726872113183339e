#pragma once

#include <string>

#include "device/context.h"
#include "device/kernel_source.h"
#include "device/kernel_sources.h"
#include "support/devices.h"

namespace prelight::test {

/// A program of a test's own, whose text includes embedded kernel files: for device functions that no kernel
/// yields the values of.
inline cl::Program buildProbe(const std::string& text) {
  auto sources = kernelSources();
  sources["probe.cl"] = text;
  const DeviceContext& device = sharedDevice().context();
  cl::Program program(device.context(), expandKernelSource("probe.cl", sources));
  program.build({device.device()}, BuildOptions().text().c_str());
  return program;
}

}  // namespace prelight::test
