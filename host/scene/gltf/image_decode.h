#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "images/picture_codecs.h"
#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns the encoded bytes of an image in a buffer view. Throws InputError when there are none or the view
/// is broken.
std::span<const std::uint8_t> imageBytes(const GltfDocument& document, std::size_t index);

/// Throws InputError when the marked images cannot be decoded within bounds: when one has a format that glTF
/// does not support, or has more texels than are decoded, or all together have more than 2^27 plus 256 per
/// byte of the document's data. Allocates no memory for that. Broken images are left to loadImage.
void checkImages(const GltfDocument& document, const std::vector<bool>& used);

/// Returns image `index` of a document; one white texel and a warning when it cannot be decoded.
Image loadImage(const GltfDocument& document, std::size_t index, Warnings& warnings);

/// Returns an image of one opaque white texel.
Image whiteImage(const std::string& name);

}  // namespace prelight
