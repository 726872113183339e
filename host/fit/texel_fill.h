#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace prelight {

/// Fills empty texels with the mean of filled neighbours, ring by ring, so that bilinear look-ups at a
/// chart's border never read an empty one. `values` is [row][column][length]; `filled`, [row][column], is 1
/// for filled texels. Does nothing if no texel is filled. `groups`, [row][column]: texels are filled only
/// from texels of their own group; empty: all are in one group.
void fillTexels(int width, int height, std::size_t length, std::span<std::uint8_t> filled,
                std::span<float> values, std::span<const std::uint32_t> groups = {});

}  // namespace prelight
