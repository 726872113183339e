// Stand-in for Open Image Denoise with the C functions that Prelight calls. Its filters average the first
// image over 3 x 3 pixels, and it logs its calls. Variants are compiled with another version, or without a
// function. FAKE_OIDN_FAULT makes the filter fail.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#ifndef FAKE_OIDN_VERSION
#define FAKE_OIDN_VERSION 20501
#endif

namespace {

struct FakeDevice {
  int error = 0;
  const char* message = nullptr;
};

struct FakeImage {
  float* pixels = nullptr;
  std::size_t width = 0, height = 0;
};

struct FakeFilter {
  FakeDevice* device = nullptr;
  FakeImage input, output;
  bool (*monitor)(void*, double) = nullptr;
  void* user = nullptr;
};

std::string& log() {
  static std::string text;
  return text;
}

void note(const std::string& line) { log() += line + "\n"; }

bool faultIs(const char* name) {
  const char* fault = std::getenv("FAKE_OIDN_FAULT");
  return fault != nullptr && std::strcmp(fault, name) == 0;
}

float meanAround(const FakeImage& image, std::size_t x, std::size_t y, std::size_t channel) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, image.height - 1); ++v)
    for (std::size_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, image.width - 1); ++u, ++count)
      sum += double(image.pixels[3 * (v * image.width + u) + channel]);
  return float(sum / count);
}

}  // namespace

extern "C" {

const char* fakeOidnLog() { return log().c_str(); }

FakeDevice* oidnNewDevice(int kind) {
  note("device " + std::to_string(kind));
  return faultIs("device") ? nullptr : new FakeDevice;
}
void oidnSetDeviceInt(FakeDevice*, const char* name, int value) {
  note(std::string("device ") + name + " " + std::to_string(value));
}
void oidnSetDeviceBool(FakeDevice*, const char* name, bool value) {
  note(std::string("device ") + name + " " + std::to_string(int(value)));
}
#ifndef FAKE_OIDN_INCOMPLETE
int oidnGetDeviceInt(FakeDevice*, const char* name) {
  return std::strcmp(name, "version") == 0 ? FAKE_OIDN_VERSION : 0;
}
#endif
int oidnGetDeviceError(FakeDevice* device, const char** message) {
  if (device == nullptr) {
    *message = "no processor";
    return 5;
  }
  *message = device->message;
  return std::exchange(device->error, 0);
}
void oidnCommitDevice(FakeDevice*) { note("device commit"); }
void oidnReleaseDevice(FakeDevice* device) {
  note("device release");
  delete device;
}

FakeFilter* oidnNewFilter(FakeDevice* device, const char* kind) {
  note(std::string("filter ") + kind);
  auto* filter = new FakeFilter;
  filter->device = device;
  return filter;
}
void oidnSetSharedFilterImage(FakeFilter* filter, const char* name, void* pixels, int format,
                              std::size_t width, std::size_t height, std::size_t, std::size_t, std::size_t) {
  note(std::string("image ") + name + " " + std::to_string(format) + " " + std::to_string(width) + "x" +
       std::to_string(height));
  const FakeImage image{static_cast<float*>(pixels), width, height};
  if (std::strcmp(name, "output") == 0)
    filter->output = image;
  else if (filter->input.pixels == nullptr || std::strcmp(name, "color") == 0)
    filter->input = image;
}
void oidnSetFilterBool(FakeFilter*, const char* name, bool value) {
  note(std::string("filter ") + name + " " + std::to_string(int(value)));
}
void oidnSetFilterInt(FakeFilter*, const char* name, int value) {
  note(std::string("filter ") + name + " " + std::to_string(value));
}
void oidnSetFilterProgressMonitorFunction(FakeFilter* filter, bool (*monitor)(void*, double), void* user) {
  filter->monitor = monitor;
  filter->user = user;
}
void oidnCommitFilter(FakeFilter*) { note("filter commit"); }
void oidnExecuteFilter(FakeFilter* filter) {
  note("filter execute");
  if (filter->monitor != nullptr && !filter->monitor(filter->user, 0.5)) {
    filter->device->error = 6;
    filter->device->message = "cancelled";
    return;
  }
  if (faultIs("filter") || faultIs("memory")) {
    filter->device->error = faultIs("memory") ? 4 : 3;
    filter->device->message = "the fake fails";
    return;
  }
  for (std::size_t y = 0; y < filter->output.height; ++y)
    for (std::size_t x = 0; x < filter->output.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        filter->output.pixels[3 * (y * filter->output.width + x) + c] =
            faultIs("nan") ? std::numeric_limits<float>::quiet_NaN() : meanAround(filter->input, x, y, c);
}
void oidnReleaseFilter(FakeFilter* filter) {
  note("filter release");
  delete filter;
}

}  // extern "C"
