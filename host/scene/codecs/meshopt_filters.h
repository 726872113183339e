#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace prelight {

/// Applies the filter COLOR of KHR_meshopt_compression, which libmeshoptimizer supports from 0.24 on: luma
/// and two chroma become red, green and blue. Elements have 4 or 8 bytes.
void decodeColors(std::span<std::uint8_t> data, std::size_t stride);

}  // namespace prelight
