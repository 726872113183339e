#pragma once

#include <string>

#include "denoise/oidn_api.h"

namespace prelight::oidn {

/// Names the file of the library; unset: it is looked for under its usual names, where the system's loader
/// looks.
constexpr const char* libraryVariable = "PRELIGHT_OIDN_LIBRARY";

struct Library {
  std::string file;  ///< that it was loaded from
  Api api;
};

/// Loads the library, which stays. Throws Error telling where it was looked for and how to get it.
Library loadLibrary();

}  // namespace prelight::oidn
