#pragma once

#include "images/image_library.h"

/// The implementations behind ImageLibrary.
namespace prelight::images {

Pixels readPixels(const std::filesystem::path& path, PictureFormat format);
PictureLayers readPictureLayers(const std::filesystem::path& path);
std::vector<std::uint8_t> encodePng(const Image& image, int channels);
Image decodeImage(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);
Image decodeAvif(std::span<const std::uint8_t> bytes, const std::string& where);
std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb);

/// Throws InputError, before memory is allocated, when a file of this size cannot hold a picture of `numbers`
/// values.
void checkNumbers(const std::filesystem::path& path, std::uint64_t numbers);

/// Returns OpenImageIO's name of a format. When it is named, only that format's reader is tried.
const char* readerOf(PictureFormat format);

}  // namespace prelight::images
