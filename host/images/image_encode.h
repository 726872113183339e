#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

enum class PngChannels : std::uint8_t { Rgb = 3, Rgba = 4 };

/// Returns the image as a .png file with 8 bits per channel. Throws Error when it cannot be encoded.
std::vector<std::uint8_t> encodePng(const Image& image, PngChannels channels = PngChannels::Rgb);

}  // namespace prelight
