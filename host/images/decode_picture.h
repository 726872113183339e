#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "images/picture_header.h"
#include "prelight/picture.h"

namespace prelight {

/// Whether a picture of this format is decoded to an Image.
bool isDecoded(PictureFormat format);

/// Throws InputError with `where` for more texels than are decoded.
void requireDecodable(const PictureExtent& extent, const std::string& where);

/// MIME type by the first bytes; empty when they are of no known picture format.
std::string imageMimeType(std::span<const std::uint8_t> bytes);

/// Decodes a PNG, JPEG, WebP, AVIF or KTX2 picture to RGBA of 8 bits, alpha not multiplied in. Throws
/// InputError with `where`.
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Throws InputError with `where` for a PNG, JPEG, WebP, AVIF or KTX2 picture whose header is broken, claims
/// more texels than are decoded, or more than so few bytes can hold.
void checkExtent(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace prelight
