#pragma once

#include "prelight/device.h"

namespace prelight::test {

/// The default device, opened once a test program.
const Device& sharedDevice();

}  // namespace prelight::test
