#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "prelight/scene.h"

namespace prelight {

/// A PNG picture of 8 bits a channel or index, without a transparent colour and interlacing, as decodeImage
/// gives it; nullopt for others and for broken ones. By libpng itself, in a module of its own: what else
/// pictures are read with takes longer to load than many a picture takes to draw (images/image_library.h).
/// `bytes`: checkExtent() has seen them. Throws Error where the module is missing.
std::optional<Image> decodePlainPng(std::span<const std::uint8_t> bytes);

}  // namespace prelight

/// What the module gives away: the same. Throws std::bad_alloc.
extern "C" bool prelightDecodePlainPng(std::span<const std::uint8_t> bytes, prelight::Image& image);
