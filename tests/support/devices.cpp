#include "support/devices.h"

namespace prelight::test {

const Device& sharedDevice() {
  static const Device device = Device::open({});
  return device;
}

}  // namespace prelight::test
