#pragma once

#include <cstdint>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// Encodes a picture as a .ktx2 file of IEEE halves, VK_FORMAT_R16G16B16A16_SFLOAT, with one uncompressed
/// level whose first row is the top (KTX 2.0). Alpha is 1. Values above the largest half are clamped to it.
std::vector<std::uint8_t> encodeHalfKtx2(const Picture& picture);

}  // namespace prelight
