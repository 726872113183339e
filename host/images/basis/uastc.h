#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace prelight {

constexpr std::size_t uastcBlockBytes = 16;

/// Decodes a block of UASTC (Khronos Data Format, UASTC) to RGBA, [row][column][channel]. Interpolation of
/// sRGB colours differs slightly. Invalid blocks become magenta.
void decodeUastc(std::span<const std::uint8_t, uastcBlockBytes> block, bool isSrgb,
                 std::array<std::uint8_t, 64>& rgba);

}  // namespace prelight
