#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace prelight {

/// The filter COLOR of KHR_meshopt_compression, which libmeshoptimizer knows from 0.24 on: luma and two
/// chroma to red, green and blue. Elements of 4 or 8 bytes.
void decodeColors(std::span<std::uint8_t> data, std::size_t stride);

}  // namespace prelight
