#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prelight {

/// Elements of a block of attributes of `stride` bytes.
std::size_t attributeBlockElements(std::size_t stride);

/// Whether a stream of attributes is of version 1, which came with KHR_meshopt_compression and which
/// libmeshoptimizer knows from 0.23 on.
bool isVersion1(std::span<const std::uint8_t> stream);

/// Decodes such a stream to all of `out`, elements of `stride` bytes. False when it is broken.
bool decodeVersion1(std::span<const std::uint8_t> stream, std::size_t stride, std::vector<std::uint8_t>& out);

}  // namespace prelight
