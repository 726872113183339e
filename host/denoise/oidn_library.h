#pragma once

#include <cstddef>
#include <string>

/// The part of the C interface of Intel Open Image Denoise 2 that Prelight calls, as its documentation states
/// it (openimagedenoise.org/documentation.html, "API"). The library is loaded at run time.

namespace prelight::oidn {

using Device = struct DeviceObject*;
using Filter = struct FilterObject*;

constexpr int version = 2;  ///< major version of the interface

constexpr int cpuDevice = 1;
constexpr int float3Format = 3;

/// Value of a filter's "quality" that selects networks of a third to a half of the work.
constexpr int balancedQuality = 5;

/// Results of getDeviceError.
constexpr int noError = 0, outOfMemory = 4, cancelled = 6;

/// Progress callback; `done` is in [0,1]. Returning false stops the filter.
using Monitor = bool (*)(void* user, double done);

/// The functions, named without the prefix "oidn".
struct Api {
  Device (*newDevice)(int kind) = nullptr;
  void (*setDeviceInt)(Device device, const char* name, int value) = nullptr;
  void (*setDeviceBool)(Device device, const char* name, bool value) = nullptr;
  int (*getDeviceInt)(Device device, const char* name) = nullptr;
  int (*getDeviceError)(Device device, const char** message) = nullptr;
  void (*commitDevice)(Device device) = nullptr;
  void (*releaseDevice)(Device device) = nullptr;
  Filter (*newFilter)(Device device, const char* kind) = nullptr;
  void (*setSharedFilterImage)(Filter filter, const char* name, void* pixels, int format, std::size_t width,
                               std::size_t height, std::size_t offset, std::size_t pixelStride,
                               std::size_t rowStride) = nullptr;
  void (*setFilterBool)(Filter filter, const char* name, bool value) = nullptr;
  void (*setFilterInt)(Filter filter, const char* name, int value) = nullptr;
  void (*setFilterProgressMonitorFunction)(Filter filter, Monitor monitor, void* user) = nullptr;
  void (*commitFilter)(Filter filter) = nullptr;
  void (*executeFilter)(Filter filter) = nullptr;
  void (*releaseFilter)(Filter filter) = nullptr;
};

/// Environment variable with the library's file. If unset, the library is looked for under its usual names
/// where the system's loader looks.
constexpr const char* libraryVariable = "PRELIGHT_OIDN_LIBRARY";

struct Library {
  std::string file;  ///< file that the library was loaded from
  Api api;
};

/// Loads the library, which stays loaded. Throws Error telling where it was looked for and how to get it.
Library loadLibrary();

}  // namespace prelight::oidn
