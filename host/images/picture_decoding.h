#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "images/picture_header.h"
#include "images/pixels.h"
#include "prelight/picture.h"

namespace prelight {

/// Decoding of pictures whose headers have been checked (requirePictureFile(), checkExtent()), by a process
/// without rights (sandbox/decoder.h) where there is one. All throw InputError about `where`.

/// Decodes EXR, HDR, PNG or JPEG to RGB as stored.
Pixels decodePixels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);

/// Decodes all layers of an EXR.
PictureLayers decodeLayers(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes PNG, JPEG, WebP or AVIF to 8-bit RGBA.
Image decodeTexels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);

}  // namespace prelight
