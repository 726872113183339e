#include "images/image_encode.h"

#include "images/image_library.h"

namespace prelight {

std::vector<std::uint8_t> encodePng(const Image& image, PngChannels channels) {
  return imageLibrary().encodePng(image, static_cast<int>(channels));
}

}  // namespace prelight
