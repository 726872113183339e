#pragma once

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "denoise/oidn_library.h"

namespace prelight::test {

/// Makes a file the denoiser's library for as long as it lives.
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

/// Log of the calls to a stand-in library so far, one line per call.
inline std::string logOf(const char* file) {
  void* module = dlopen(file, RTLD_LAZY);
  return reinterpret_cast<const char* (*)()>(dlsym(module, "fakeOidnLog"))();
}

}  // namespace prelight::test
