#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cstdint>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

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
                         static_cast<std::uint64_t>(spec.height));
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
