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

/// Decodes a PNG, JPEG or WebP picture to RGBA of 8 bits, alpha not multiplied in. Throws InputError with
/// `where`.
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Throws InputError with `where` for a PNG, JPEG or WebP picture whose header is broken, claims more texels
/// than are decoded, or more than so few bytes can hold.
void checkExtent(std::span<const std::uint8_t> bytes, const std::string& where);

/// Throws InputError when the images that are marked cannot be decoded within bounds: when one is of a format
/// that glTF has no place for, or has more texels than are decoded, or all together have more than 2^27 and
/// 256 for each byte of the document's data. Takes no memory for that. Images that are broken are left to
/// loadImage.
void checkImages(const GltfDocument& document, const std::vector<bool>& used);

/// Image `index` of a document; one white texel and a warning when it cannot be decoded.
Image loadImage(const GltfDocument& document, std::size_t index, Warnings& warnings);

/// One opaque white texel.
Image whiteImage(const std::string& name);

}  // namespace prelight
