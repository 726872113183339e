#include "denoise/oidn_library.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "base/module.h"
#include "prelight/error.h"

namespace prelight::oidn {

namespace {

constexpr std::array usualNames = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so"};

std::string howToGetIt() {
  return fmt::format(
      "get version 2 from openimagedenoise.org, or with pip install pyoidn, and name its "
      "libOpenImageDenoise.so in the environment variable {}, or put its folder where the loader looks "
      "(LD_LIBRARY_PATH)",
      libraryVariable);
}

void* openNamed(const char* file) {
  std::string reason;
  void* module = findModule(file, reason);
  if (module == nullptr)
    throw Error(ExitCode::RuntimeFailure, libraryVariable,
                fmt::format("Open Image Denoise cannot be loaded: {}", reason),
                fmt::format("correct or unset the variable; {}", howToGetIt()));
  return module;
}

void* openUsual() {
  std::string reason, reasons;
  for (const char* name : usualNames) {
    if (void* module = findModule(name, reason)) return module;
    reasons += (reasons.empty() ? "" : "; ") + reason;
  }
  throw Error(ExitCode::RuntimeFailure, "denoiser",
              fmt::format("Open Image Denoise was not found: {}", reasons), howToGetIt());
}

template <typename Function>
void take(void* module, const char* name, Function*& function) {
  void* found = findFunction(module, name);
  if (found == nullptr)
    throw Error(
        ExitCode::RuntimeFailure, "denoiser",
        fmt::format(
            "the library that was found has no function {}, so it is not Open Image Denoise version {}", name,
            version),
        howToGetIt());
  function = reinterpret_cast<Function*>(found);
}

Api functionsOf(void* module) {
  Api api;
  take(module, "oidnNewDevice", api.newDevice);
  take(module, "oidnSetDeviceInt", api.setDeviceInt);
  take(module, "oidnSetDeviceBool", api.setDeviceBool);
  take(module, "oidnGetDeviceInt", api.getDeviceInt);
  take(module, "oidnGetDeviceError", api.getDeviceError);
  take(module, "oidnCommitDevice", api.commitDevice);
  take(module, "oidnReleaseDevice", api.releaseDevice);
  take(module, "oidnNewFilter", api.newFilter);
  take(module, "oidnSetSharedFilterImage", api.setSharedFilterImage);
  take(module, "oidnSetFilterBool", api.setFilterBool);
  take(module, "oidnSetFilterInt", api.setFilterInt);
  take(module, "oidnSetFilterProgressMonitorFunction", api.setFilterProgressMonitorFunction);
  take(module, "oidnCommitFilter", api.commitFilter);
  take(module, "oidnExecuteFilter", api.executeFilter);
  take(module, "oidnReleaseFilter", api.releaseFilter);
  return api;
}

}  // namespace

Library loadLibrary() {
  const char* named = std::getenv(libraryVariable);
  void* module = named != nullptr && *named != '\0' ? openNamed(named) : openUsual();
  Library library{{}, functionsOf(module)};
  library.file = fileOfFunction(reinterpret_cast<void*>(library.api.newDevice));
  return library;
}

}  // namespace prelight::oidn
