#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Appends an accessor whose element i is element source[i] of `accessor`, as a vertex attribute: sparse
/// values are filled in, elements begin at multiples of 4 bytes. Returns its index. Every source must be in
/// range. `negated`: [element of the copy], 1: it is the source's negated; where any is, values become
/// floats; empty: none is.
int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated = {});

}  // namespace prelight
