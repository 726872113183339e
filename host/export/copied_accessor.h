#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/gltf_document.h"

namespace prelight {

enum class CopiedValues : std::uint8_t { Same, Negated };

/// Appends an accessor whose element i is element source[i] of `accessor`, as a vertex attribute: sparse
/// values are filled in, elements begin at multiples of 4 bytes; negated values are floats. Returns its
/// index. Every source must be in range.
int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       CopiedValues values = CopiedValues::Same);

}  // namespace prelight
