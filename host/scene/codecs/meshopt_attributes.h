#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prelight {

/// Returns the number of elements in a block of attributes of `stride` bytes.
std::size_t attributeBlockElements(std::size_t stride);

/// Returns true when a stream of attributes is of version 1, which KHR_meshopt_compression introduced and
/// which libmeshoptimizer supports from 0.23 on.
bool isVersion1(std::span<const std::uint8_t> stream);

/// Decodes such a stream to all of `out`, elements of `stride` bytes. Returns false when it is broken.
bool decodeVersion1(std::span<const std::uint8_t> stream, std::size_t stride, std::vector<std::uint8_t>& out);

}  // namespace prelight
