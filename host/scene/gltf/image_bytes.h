#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns the encoded bytes of an image in a buffer view. Throws InputError when there are none or the view
/// is broken.
std::span<const std::uint8_t> imageBytes(const GltfDocument& document, std::size_t index);

}  // namespace prelight
