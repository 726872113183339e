#pragma once

#include <string>

#include "denoise/oidn_api.h"

namespace prelight::oidn {

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
