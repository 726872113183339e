#pragma once

#include "prelight/device.h"

namespace prelight::test {

/// The default device, opened once per test program.
const Device& sharedDevice();

}  // namespace prelight::test
