#include <OpenImageIO/imageio.h>

#include "base/error.h"
#include "images/module/functions.h"

namespace prelight::images {

namespace {

/// One image of a file.
struct Part {
  OIIO::ImageSpec spec;
  OIIO::TypeDesc type;
  const void* pixels;
};

void writeParts(const std::filesystem::path& shown, const std::filesystem::path& path,
                const std::vector<Part>& parts) {
  const auto fail = [&](const std::string& reason) {
    throw Error(ExitCode::RuntimeFailure, shown.string(), "cannot be written: " + reason);
  };
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output) fail(OIIO::geterror());
  std::vector<OIIO::ImageSpec> specs;
  for (const Part& part : parts) specs.push_back(part.spec);
  const bool one = parts.size() == 1;
  if (!(one ? output->open(path.string(), specs[0])
            : output->open(path.string(), static_cast<int>(specs.size()), specs.data())))
    fail(output->geterror());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && !output->open(path.string(), specs[i], OIIO::ImageOutput::AppendSubimage))
      fail(output->geterror());
    if (!output->write_image(parts[i].type, parts[i].pixels)) fail(output->geterror());
  }
  if (!output->close()) fail(output->geterror());
}

}  // namespace

void writePng(const std::filesystem::path& shown, const std::filesystem::path& path, int width, int height,
              std::span<const std::uint8_t> rgb) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  writeParts(shown, path, {{spec, OIIO::TypeDesc::UINT8, rgb.data()}});
}

void writeExr(const std::filesystem::path& shown, const std::filesystem::path& path, int width, int height,
              std::span<const ExrPart> parts) {
  std::vector<Part> written;
  for (const ExrPart& part : parts) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(part.channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = part.channels;
    spec.attribute("compression", "zip");
    // Else OpenImageIO notes the time, and equal pictures would be unequal files.
    spec.attribute("DateTime", "");
    if (!part.name.empty()) spec.attribute("oiio:subimagename", part.name);
    written.push_back({std::move(spec), OIIO::TypeDesc::FLOAT, part.values.data()});
  }
  writeParts(shown, path, written);
}

}  // namespace prelight::images
