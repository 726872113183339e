#include "images/image_library.h"

#include <dlfcn.h>

#include "base/error.h"

namespace prelight {

const ImageLibrary& imageLibrary() {
  constexpr const char* file = "libprelight_images.so";
  const auto fail = [&] {
    const char* reason = dlerror();
    throw Error(ExitCode::RuntimeFailure, file,
                std::string("cannot be loaded: ") + (reason != nullptr ? reason : "no such symbol"),
                "install it beside the other libraries of prelight");
  };
  // Stays loaded: the next call finds it at once.
  void* module = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (module == nullptr) fail();
  const auto give = reinterpret_cast<decltype(&prelightImageLibrary)>(dlsym(module, "prelightImageLibrary"));
  if (give == nullptr) fail();
  return *give();
}

}  // namespace prelight
