#pragma once

#include "fuzz/target.h"

namespace prelight::fuzz {

/// Changes a GLB file by its structure: values of the JSON tree are replaced, moved, repeated and removed,
/// bytes of buffer views and texts of the JSON are changed blindly, and the lengths of the chunks stay right.
/// Other files, and every eighth input, are changed blindly. The seed decides alone.
std::size_t mutateGlb(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind);

}  // namespace prelight::fuzz
