#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// A picture as a .ktx2 file of IEEE halves, VK_FORMAT_R16G16B16A16_SFLOAT, one level, uncompressed, first
/// row at the top (KTX 2.0). Alpha is 1. Values above the largest half become that.
std::vector<std::uint8_t> encodeHalfKtx2(const Picture& picture);

}  // namespace prelight
