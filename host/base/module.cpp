#include "base/module.h"

#include <dlfcn.h>

#include <string>

#include "prelight/error.h"

namespace prelight {

namespace {

/// The loader tells by words alone.
bool isWantOfMemory(const std::string& reason) {
  for (const char* words :
       {"failed to map", "cannot map", "Cannot allocate memory", "cannot allocate memory"})
    if (reason.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace

void* moduleFunction(const char* file, const char* function) {
  const auto fail = [&] {
    const char* found = dlerror();
    const std::string reason = found != nullptr ? found : "no such symbol";
    if (isWantOfMemory(reason))
      throw Error(ExitCode::OutOfMemory, file, "cannot be loaded: " + reason,
                  "raise the limit of the address space with ulimit -v");
    throw Error(ExitCode::RuntimeFailure, file, "cannot be loaded: " + reason,
                "install it beside the other libraries of prelight");
  };
  // Stays loaded: the next call finds it at once.
  void* module = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (module == nullptr) fail();
  void* symbol = dlsym(module, function);
  if (symbol == nullptr) fail();
  return symbol;
}

}  // namespace prelight
