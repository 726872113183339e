#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/diagnostics.h"
#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace prelight {

/// MIME type by the first bytes; empty when they are of no known picture format.
std::string imageMimeType(std::span<const std::uint8_t> bytes);

/// Decodes an encoded picture to RGBA of 8 bits, alpha not multiplied in. Throws InputError with `where`.
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Image `index` of a document; one white texel and a warning when it cannot be decoded.
Image loadImage(const GltfDocument& document, std::size_t index, Warnings& warnings);

/// One opaque white texel.
Image whiteImage(const std::string& name);

}  // namespace prelight
