#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Appends an accessor for a vertex attribute whose element i is element source[i] of `accessor`, and returns
/// its index. Sparse values are filled in, and elements begin at multiples of 4 bytes. Every source must be
/// in range. `negated` is [element of the copy], 1 for a negated value; if any is, values become floats.
/// Empty: none is negated.
int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated = {});

}  // namespace prelight
