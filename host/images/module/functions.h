#pragma once

#include "images/image_library.h"

/// The functions of ImageLibrary.
namespace prelight::images {

Pixels readPixels(const std::filesystem::path& path);
PictureLayers readPictureLayers(const std::filesystem::path& path);
std::vector<std::uint8_t> encodePng(const Image& image);
Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& name, const std::string& where);
std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb);
std::vector<std::uint8_t> encodeExr(const std::filesystem::path& shown, int width, int height,
                                    std::span<const ExrPart> parts);

}  // namespace prelight::images
