#include "base/module.h"

#include <dlfcn.h>

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

/// Why the loader found nothing.
std::string loaderReason() {
  const char* found = dlerror();
  return found != nullptr ? found : "no such symbol";
}

}  // namespace

void* findModule(const char* file, std::string& reason) {
  // Stays loaded: the next call finds it at once.
  void* module = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (module != nullptr) return module;
  reason = loaderReason();
  if (isWantOfMemory(reason))
    throw Error(ExitCode::OutOfMemory, file, "cannot be loaded: " + reason,
                "raise the limit of the address space with ulimit -v");
  return nullptr;
}

void* findFunction(void* module, const char* function) { return dlsym(module, function); }

std::string fileOfFunction(void* function) {
  Dl_info info{};
  return dladdr(function, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

void* moduleFunction(const char* file, const char* function) {
  std::string reason;
  void* module = findModule(file, reason);
  void* symbol = module != nullptr ? findFunction(module, function) : nullptr;
  if (symbol != nullptr) return symbol;
  if (module != nullptr) reason = loaderReason();
  throw Error(ExitCode::RuntimeFailure, file, "cannot be loaded: " + reason,
              "install it beside the other libraries of prelight");
}

}  // namespace prelight
