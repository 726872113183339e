#include "portability/devices.h"

namespace prelight::test {

const std::vector<Device>& allDevices() {
  static const std::vector<Device> devices = [] {
    std::vector<Device> opened;
    for (const auto& info : listDevices()) {
      DeviceOptions options;
      options.selector = std::to_string(info.index);
      opened.push_back(Device::open(options));
    }
    return opened;
  }();
  return devices;
}

std::string nameOf(const Device& device) { return device.info().platform + ", " + device.info().name; }

}  // namespace prelight::test
