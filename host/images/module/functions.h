#pragma once

#include "images/image_library.h"

/// The functions of ImageLibrary.
namespace prelight::images {

Pixels readPixels(const std::filesystem::path& path, PictureFormat format);
PictureLayers readPictureLayers(const std::filesystem::path& path);
std::vector<std::uint8_t> encodePng(const Image& image, int channels);
Image decodeImage(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);
Image decodeAvif(std::span<const std::uint8_t> bytes, const std::string& where);
std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb);

/// Throws InputError when a picture of so many numbers cannot be in a file of this size, before memory is
/// taken for it.
void checkNumbers(const std::filesystem::path& path, std::uint64_t numbers);

/// OpenImageIO's name of the format: asked for by it, only that format's reader looks at a file.
const char* readerOf(PictureFormat format);

}  // namespace prelight::images
