#pragma once

#include <string>

#include "device/kernel.h"
#include "device/program_cache.h"
#include "support/devices.h"

namespace prelight::test {

/// Adds a kernel file of a test's own, which may include embedded files, and returns its name. It tests
/// device functions whose values no kernel returns.
inline std::string probeFile(const std::string& text) {
  const std::string file = "probe/" + sha256(text) + ".cl";
  sharedDevice().context().addFile(file, text);
  return file;
}

}  // namespace prelight::test
