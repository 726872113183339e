#pragma once

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "denoise/oidn_library.h"

namespace prelight::test {

/// While it lives, the denoiser's library is this file.
class UsedLibrary {
 public:
  explicit UsedLibrary(const char* file) {
    if (const char* before = std::getenv(oidn::libraryVariable)) before_ = before;
    setenv(oidn::libraryVariable, file, 1);
  }
  ~UsedLibrary() {
    unsetenv("FAKE_OIDN_FAULT");
    if (before_.empty())
      unsetenv(oidn::libraryVariable);
    else
      setenv(oidn::libraryVariable, before_.c_str(), 1);
  }

  void failWith(const char* fault) { setenv("FAKE_OIDN_FAULT", fault, 1); }

 private:
  std::string before_;
};

/// What the stand-in of that file was told so far, a line a call.
inline std::string logOf(const char* file) {
  void* module = dlopen(file, RTLD_LAZY);
  return reinterpret_cast<const char* (*)()>(dlsym(module, "fakeOidnLog"))();
}

}  // namespace prelight::test
