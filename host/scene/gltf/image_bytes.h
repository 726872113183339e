#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Encoded bytes of an image in a buffer view. Throws InputError when there is none, or it is broken.
std::span<const std::uint8_t> imageBytes(const GltfDocument& document, std::size_t index);

}  // namespace prelight
