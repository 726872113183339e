#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "images/picture_header.h"
#include "prelight/picture.h"

namespace prelight {

/// Returns whether pictures of a format can be decoded to an Image.
bool isDecoded(PictureFormat format);

/// Throws InputError with `where` for pictures with more texels than the limit.
void requireDecodable(const PictureExtent& extent, const std::string& where);

/// Returns the MIME type that the first bytes indicate, or an empty text for unknown formats.
std::string imageMimeType(std::span<const std::uint8_t> bytes);

/// Decodes a PNG, JPEG, WebP, AVIF or KTX2 picture to 8-bit RGBA without premultiplied alpha. Throws
/// InputError with `where`.
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Throws InputError with `where` for a PNG, JPEG, WebP, AVIF or KTX2 picture whose header is broken or
/// claims more texels than the limit or than so few bytes can hold.
void checkExtent(std::span<const std::uint8_t> bytes, const std::string& where);

enum class PngChannels : std::uint8_t { Rgb = 3, Rgba = 4 };

/// Returns the image as a .png file with 8 bits per channel. Throws Error when it cannot be encoded.
std::vector<std::uint8_t> encodePng(const Image& image, PngChannels channels = PngChannels::Rgb);

}  // namespace prelight
