#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

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
