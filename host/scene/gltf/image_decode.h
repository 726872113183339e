#pragma once

#include <string>

#include "images/decode_picture.h"
#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

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
