#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <system_error>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {
namespace {

constexpr auto maxTexels = static_cast<std::int64_t>(mostTexels);

/// Returns the indices of the red, green and blue channels.
std::array<int, 3> colorChannels(const OIIO::ImageSpec& spec) {
  const auto named = [&](const char* name) {
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
  };
  const std::array<int, 3> rgb{named("R"), named("G"), named("B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  if (spec.nchannels >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

void checkSize(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  const std::int64_t texels = std::int64_t{spec.width} * spec.height;
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    throw InputError(path.string(), "is not a two-dimensional picture");
  }
  if (texels > maxTexels) {
    throw InputError(path.string(),
                     std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                         " texels are more than " + std::to_string(maxTexels),
                     "scale the picture down");
  }
}

}  // namespace

void checkNumbers(const std::filesystem::path& path, std::uint64_t numbers) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) throw InputError(path.string(), "cannot be read: " + error.message());
  if (numbers > mostNumbers(bytes))
    throw InputError(path.string(),
                     "claims " + std::to_string(numbers) + " numbers in " + std::to_string(bytes) +
                         " bytes, expected at most " + std::to_string(mostNumbers(bytes)),
                     "the file is damaged, or scale the picture down");
}

const char* readerOf(PictureFormat format) {
  switch (format) {
    case PictureFormat::Png:
      return "png";
    case PictureFormat::Jpeg:
      return "jpeg";
    case PictureFormat::WebP:
      return "webp";
    case PictureFormat::Exr:
      return "openexr";
    case PictureFormat::Hdr:
      return "hdr";
    default:
      return "none";
  }
}

Pixels readPixels(const std::filesystem::path& path, PictureFormat format) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::create(readerOf(format));
  if (!input) throw InputError(path.string(), "cannot be read as a picture: " + OIIO::geterror());
  OIIO::ImageSpec spec;
  if (!input->open(path.string(), spec, hints))
    throw InputError(path.string(), "cannot be read as a picture: " + input->geterror());
  checkSize(path, spec);
  checkNumbers(path, static_cast<std::uint64_t>(std::int64_t{spec.width} * spec.height * spec.nchannels));

  const auto rgb = colorChannels(spec);
  const auto [first, last] = std::minmax_element(rgb.begin(), rgb.end());
  const int channels = *last - *first + 1;
  const std::size_t texels = static_cast<std::size_t>(spec.width) * spec.height;
  std::vector<float> values(texels * channels);
  if (!input->read_image(0, 0, *first, *last + 1, OIIO::TypeDesc::FLOAT, values.data())) {
    throw InputError(path.string(), "broken or cut short: " + input->geterror());
  }
  Pixels pixels{spec.width, spec.height, std::vector<glm::vec3>(texels)};
  for (std::size_t i = 0; i < texels; ++i) {
    for (int c = 0; c < 3; ++c) pixels.rgb[i][c] = values[i * channels + rgb[c] - *first];
  }
  return pixels;
}

}  // namespace prelight::images
