#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

std::vector<std::uint8_t> encodePng(const Image& image, int channels) {
  std::vector<std::uint8_t> values;
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
    values.insert(values.end(), &image.rgba[i], &image.rgba[i] + channels);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("image.png", &memory);
  OIIO::ImageSpec spec(image.width, image.height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!output || !output->open("image.png", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, values.data()) || !output->close())
    throw Error(ExitCode::RuntimeFailure, "image \"" + image.name + "\"",
                "cannot be written as PNG: " + (output ? output->geterror() : OIIO::geterror()));
  return bytes;
}

namespace {

[[noreturn]] void fail(const std::filesystem::path& shown, const std::string& reason) {
  throw Error(ExitCode::RuntimeFailure, shown.string(), "cannot be written: " + reason);
}

}  // namespace

std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::string format = "picture.png";  // selects the format; no such file is made
  const auto output = OIIO::ImageOutput::create(format, &memory);
  if (!output) fail(shown, OIIO::geterror());
  if (!output->open(format, spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) ||
      !output->close())
    fail(shown, output->geterror());
  return bytes;
}

}  // namespace prelight::images
