#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <system_error>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

namespace {

constexpr auto maxTexels = static_cast<std::int64_t>(mostPictureTexels);
/// OpenImageIO allocates this many lines at once, also for pictures of fewer.
constexpr int linesAtOnce = 256;

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
  checkNumbers(path, static_cast<std::uint64_t>(std::int64_t{spec.width} *
                                                std::max(spec.height, linesAtOnce) * spec.nchannels));

  const auto rgb = colorChannels(spec);
  const int first = *std::min_element(rgb.begin(), rgb.end());
  const int end = *std::max_element(rgb.begin(), rgb.end()) + 1;
  const int channels = end - first;
  const std::size_t texels = static_cast<std::size_t>(spec.width) * spec.height;
  const auto readInto = [&](float* values) {
    if (!input->read_image(0, 0, first, end, OIIO::TypeDesc::FLOAT, values))
      throw InputError(path.string(), "broken or cut short: " + input->geterror());
  };
  if (std::is_sorted(rgb.begin(), rgb.end()) && channels == 3) {  // needs half the memory
    Pixels pixels{spec.width, spec.height, std::vector<glm::vec3>(texels)};
    readInto(&pixels.rgb.data()->x);
    return pixels;
  }
  std::vector<float> values(texels * channels);
  readInto(values.data());
  Pixels pixels{spec.width, spec.height, std::vector<glm::vec3>(texels)};
  for (std::size_t i = 0; i < texels; ++i) {
    for (int c = 0; c < 3; ++c) pixels.rgb[i][c] = values[i * channels + rgb[c] - first];
  }
  return pixels;
}

namespace {

constexpr int maxSide = 1 << 14, maxChannels = 256;

void readPart(const std::filesystem::path& path, OIIO::ImageInput& input, int part, PictureLayers& layers) {
  const OIIO::ImageSpec spec = input.spec(part);
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.width > maxSide ||
      spec.height > maxSide || spec.nchannels > maxChannels)
    throw InputError(path.string(),
                     fmt::format("{} x {} texels of {} channels, expected at most {} x {} of {}", spec.width,
                                 spec.height, spec.nchannels, maxSide, maxSide, maxChannels));
  if (part == 0) {
    layers.width = spec.width;
    layers.height = spec.height;
  }
  if (spec.width != layers.width || spec.height != layers.height)
    throw InputError(path.string(), fmt::format("part {} has {} x {} texels, the first has {} x {}", part,
                                                spec.width, spec.height, layers.width, layers.height));
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  checkNumbers(path, (layers.channels.size() + channels) * static_cast<std::uint64_t>(spec.width) *
                         static_cast<std::uint64_t>(std::max(spec.height, linesAtOnce)));
  const std::size_t texels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<float> values(texels * channels);
  if (!input.read_image(part, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw InputError(path.string(), "broken or cut short: " + input.geterror());
  for (std::size_t c = 0; c < channels; ++c) {
    PictureChannel channel{spec.channelnames[c], std::vector<float>(texels)};
    for (std::size_t i = 0; i < texels; ++i) channel.values[i] = values[i * channels + c];
    layers.channels.push_back(std::move(channel));
  }
}

}  // namespace

PictureLayers readPictureLayers(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::create(readerOf(PictureFormat::Exr));
  if (!input) throw InputError(path.string(), "cannot be read as a picture: " + OIIO::geterror());
  OIIO::ImageSpec first;
  if (!input->open(path.string(), first))
    throw InputError(path.string(), "cannot be read as a picture: " + input->geterror());
  PictureLayers layers;
  for (int part = 0; input->seek_subimage(part, 0); ++part) readPart(path, *input, part, layers);
  (void)input->geterror();  // clears the error of seeking past the last part
  return layers;
}

}  // namespace prelight::images
