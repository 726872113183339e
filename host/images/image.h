#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace prelight {

/// A decoded picture: RGBA, 8 bits a channel, rows top to bottom, values as stored in the file
/// (colour textures are sRGB-encoded). An unreadable image is replaced by one white texel and a warning.
struct Image {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< [row][column][channel]
};

}  // namespace prelight
