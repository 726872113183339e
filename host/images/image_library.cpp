#include "images/image_library.h"

#include "base/module.h"

namespace prelight {

const ImageLibrary& imageLibrary() {
  void* give = moduleFunction("libprelight_images.so", "prelightImageLibrary");
  return *reinterpret_cast<decltype(&prelightImageLibrary)>(give)();
}

}  // namespace prelight
