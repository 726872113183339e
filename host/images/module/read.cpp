#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

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

void checkSize(const OIIO::ImageSpec& spec, const std::string& where) {
  const std::int64_t texels = std::int64_t{spec.width} * spec.height;
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    throw InputError(where, "is not a two-dimensional picture");
  }
  if (texels > maxTexels) {
    throw InputError(where,
                     std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                         " texels are more than " + std::to_string(maxTexels),
                     "scale the picture down");
  }
}

}  // namespace

void checkNumbers(std::uint64_t bytes, std::uint64_t numbers, const std::string& where) {
  if (numbers > mostNumbers(bytes))
    throw InputError(where,
                     "claims " + std::to_string(numbers) + " numbers in " + std::to_string(bytes) +
                         " bytes, expected at most " + std::to_string(mostNumbers(bytes)),
                     "the file is damaged, or scale the picture down");
}

namespace {

/// Returns OpenImageIO's name of a format. When it is named, only that format's reader is tried.
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

}  // namespace

OpenPicture::OpenPicture(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where)
    : memory_(const_cast<std::uint8_t*>(bytes.data()), bytes.size()) {
  OIIO::Filesystem::IOProxy* proxy = &memory_;
  OIIO::ImageSpec wishes;
  // The readers take the proxy from the configuration and ignore the one passed to open().
  wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  const char* reader = readerOf(format);
  input_ = OIIO::ImageInput::create(reader, false, &wishes, &memory_, std::string_view());
  if (!input_) throw InputError(where, "cannot decode the picture: " + OIIO::geterror());
  // The name only selects the reader; no such file is opened.
  if (!input_->open(std::string("x.") + reader, spec_, wishes))
    throw InputError(where, "cannot decode the picture: " + input_->geterror());
}

void useOneThread() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

Pixels decodePixels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where) {
  const OpenPicture picture(bytes, format, where);
  const OIIO::ImageSpec& spec = picture.spec();
  checkSize(spec, where);
  checkNumbers(bytes.size(),
               static_cast<std::uint64_t>(std::int64_t{spec.width} * std::max(spec.height, linesAtOnce) *
                                          spec.nchannels),
               where);

  const auto rgb = colorChannels(spec);
  const int first = *std::min_element(rgb.begin(), rgb.end());
  const int end = *std::max_element(rgb.begin(), rgb.end()) + 1;
  const int channels = end - first;
  const std::size_t texels = static_cast<std::size_t>(spec.width) * spec.height;
  const auto readInto = [&](float* values) {
    if (!picture.input().read_image(0, 0, first, end, OIIO::TypeDesc::FLOAT, values))
      throw InputError(where, "broken or cut short: " + picture.input().geterror());
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

void readPart(OIIO::ImageInput& input, std::uint64_t bytes, int part, PictureLayers& layers,
              const std::string& where) {
  const OIIO::ImageSpec spec = input.spec(part);
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.width > maxSide ||
      spec.height > maxSide || spec.nchannels > maxChannels)
    throw InputError(where,
                     fmt::format("{} x {} texels of {} channels, expected at most {} x {} of {}", spec.width,
                                 spec.height, spec.nchannels, maxSide, maxSide, maxChannels));
  if (part == 0) {
    layers.width = spec.width;
    layers.height = spec.height;
  }
  if (spec.width != layers.width || spec.height != layers.height)
    throw InputError(where, fmt::format("part {} has {} x {} texels, the first has {} x {}", part, spec.width,
                                        spec.height, layers.width, layers.height));
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  checkNumbers(bytes,
               (layers.channels.size() + channels) * static_cast<std::uint64_t>(spec.width) *
                   static_cast<std::uint64_t>(std::max(spec.height, linesAtOnce)),
               where);
  const std::size_t texels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<float> values(texels * channels);
  if (!input.read_image(part, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw InputError(where, "broken or cut short: " + input.geterror());
  for (std::size_t c = 0; c < channels; ++c) {
    PictureChannel channel{spec.channelnames[c], std::vector<float>(texels)};
    for (std::size_t i = 0; i < texels; ++i) channel.values[i] = values[i * channels + c];
    layers.channels.push_back(std::move(channel));
  }
}

}  // namespace

PictureLayers decodeLayers(std::span<const std::uint8_t> bytes, const std::string& where) {
  const OpenPicture picture(bytes, PictureFormat::Exr, where);
  OIIO::ImageInput& input = picture.input();
  PictureLayers layers;
  for (int part = 0; input.seek_subimage(part, 0); ++part) readPart(input, bytes.size(), part, layers, where);
  (void)input.geterror();  // clears the error of seeking past the last part
  return layers;
}

}  // namespace prelight::images
