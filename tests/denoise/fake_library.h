#pragma once

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "denoise/oidn_library.h"
#include "support/environment_variable.h"

namespace prelight::test {

/// Makes a file the denoiser's library for as long as it lives.
class UsedLibrary {
 public:
  explicit UsedLibrary(const char* file) : file_(oidn::libraryVariable, file) {}
  ~UsedLibrary() { unsetenv("FAKE_OIDN_FAULT"); }

  void failWith(const char* fault) { setenv("FAKE_OIDN_FAULT", fault, 1); }

 private:
  EnvironmentVariable file_;
};

/// Log of the calls to a stand-in library so far, one line per call.
inline std::string logOf(const char* file) {
  void* module = dlopen(file, RTLD_LAZY);
  return reinterpret_cast<const char* (*)()>(dlsym(module, "fakeOidnLog"))();
}

}  // namespace prelight::test
