#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "prelight/scene.h"

namespace prelight {

/// Decodes a PNG picture with 8 bits per channel or index, without transparent colour and interlacing, as
/// decodeImage() does. Returns nullopt for others and for broken ones. It uses libpng directly, in a module
/// of its own, because the image library takes longer to load than many a picture takes to draw
/// (images/image_library.h). `bytes` must have passed checkExtent(). Throws Error where the module is
/// missing.
std::optional<Image> decodePlainPng(std::span<const std::uint8_t> bytes);

}  // namespace prelight

/// Entry point of the module. Returns false where decodePlainPng() returns nullopt. Throws std::bad_alloc.
extern "C" bool prelightDecodePlainPng(std::span<const std::uint8_t> bytes, prelight::Image& image);
