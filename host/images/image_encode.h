#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// The image as a .png file of RGB, 8 bits a channel. Throws Error when it cannot be encoded.
std::vector<std::uint8_t> encodePng(const Image& image);

}  // namespace prelight
