#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>

#include "images/image_library.h"

/// The implementations behind ImageLibrary.
namespace prelight::images {

Pixels decodePixels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);
PictureLayers decodeLayers(std::span<const std::uint8_t> bytes, const std::string& where);
void useOneThread();
std::vector<std::uint8_t> encodePng(const Image& image, int channels);
Image decodeImage(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);
Image decodeAvif(std::span<const std::uint8_t> bytes, const std::string& where);
std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb);

/// Throws InputError, before memory is allocated, when a file of `bytes` cannot hold a picture of `numbers`
/// values.
void checkNumbers(std::uint64_t bytes, std::uint64_t numbers, const std::string& where);

/// A picture in memory that OpenImageIO reads. It is opened by the reader of its format alone.
class OpenPicture {
 public:
  /// Throws InputError about `where`.
  OpenPicture(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);

  OIIO::ImageInput& input() const { return *input_; }
  const OIIO::ImageSpec& spec() const { return spec_; }

 private:
  OIIO::Filesystem::IOMemReader memory_;
  OIIO::ImageSpec spec_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace prelight::images
