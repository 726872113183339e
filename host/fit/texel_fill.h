#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace prelight {

/// Gives texels that hold nothing the mean of their neighbours that do, ring by ring, so that a bilinear
/// look-up at a chart's border never meets one that was not filled. values [row][column][length], filled
/// [row][column] is 1 where they are; nothing happens when none is. `groups`, [row][column]: texels take
/// after those of their own group alone; empty: all are of one.
void fillTexels(int width, int height, std::size_t length, std::span<std::uint8_t> filled,
                std::span<float> values, std::span<const std::uint32_t> groups = {});

}  // namespace prelight
