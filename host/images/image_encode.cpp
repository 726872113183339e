#include "images/image_encode.h"

#include "images/image_library.h"

namespace prelight {

std::vector<std::uint8_t> encodePng(const Image& image) { return imageLibrary().encodePng(image); }

}  // namespace prelight
