#include <avif/avif.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

// Decodes with libavif, because OpenImageIO reads AVIF only from files and does not limit the claimed size.
Image decodeAvif(std::span<const std::uint8_t> bytes, const std::string& where) {
  const auto check = [&](avifResult result) {
    if (result != AVIF_RESULT_OK)
      throw InputError(where, std::string("cannot decode the picture: ") + avifResultToString(result));
  };
  const std::unique_ptr<avifDecoder, decltype(&avifDecoderDestroy)> decoder(avifDecoderCreate(),
                                                                            &avifDecoderDestroy);
  if (!decoder) throw Error(ExitCode::OutOfMemory, where, "no memory for the picture");
  decoder->codecChoice = AVIF_CODEC_CHOICE_DAV1D;  // the codec that respects the limit
  decoder->imageSizeLimit = static_cast<std::uint32_t>(mostPictureTexels);
  decoder->imageDimensionLimit = static_cast<std::uint32_t>(longestSide);
  decoder->ignoreExif = AVIF_TRUE;
  decoder->ignoreXMP = AVIF_TRUE;
  // Some writers omit data that decoding does not need.
  decoder->strictFlags = AVIF_STRICT_DISABLED;
  check(avifDecoderSetIOMemory(decoder.get(), bytes.data(), bytes.size()));
  check(avifDecoderParse(decoder.get()));
  // The stream must not claim more than the file's header.
  decoder->imageSizeLimit = decoder->image->width * decoder->image->height;
  check(avifDecoderNextImage(decoder.get()));

  const avifImage& source = *decoder->image;
  Image image;
  image.width = static_cast<int>(source.width);
  image.height = static_cast<int>(source.height);
  image.rgba.resize(std::size_t{4} * source.width * source.height);
  avifRGBImage rgb{};
  avifRGBImageSetDefaults(&rgb, &source);
  rgb.depth = 8;
  rgb.format = AVIF_RGB_FORMAT_RGBA;
  rgb.pixels = image.rgba.data();
  rgb.rowBytes = 4 * source.width;
  check(avifImageYUVToRGB(&source, &rgb));
  return image;
}

namespace {

/// Expands grey, grey-alpha, RGB or RGBA texels to RGBA.
void spreadChannels(const std::vector<std::uint8_t>& from, int channels, std::vector<std::uint8_t>& rgba) {
  const std::size_t texels = rgba.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    const std::uint8_t* in = &from[i * static_cast<std::size_t>(channels)];
    std::uint8_t* out = &rgba[i * 4];
    const bool grey = channels < 3;
    out[0] = in[0];
    out[1] = grey ? in[0] : in[1];
    out[2] = grey ? in[0] : in[2];
    out[3] = channels == 2 ? in[1] : channels >= 4 ? in[3] : std::uint8_t{255};
  }
}

}  // namespace

Image decodeImage(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where) {
  if (format == PictureFormat::Avif) return decodeAvif(bytes, where);
  const OpenPicture picture(bytes, format, where);
  const OIIO::ImageSpec& spec = picture.spec();
  const std::int64_t texels = std::int64_t{spec.width} * spec.height;
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 ||
      static_cast<std::uint64_t>(texels) > mostPictureTexels) {
    throw InputError(where,
                     fmt::format("a picture of {} x {} texels is not usable", spec.width, spec.height));
  }
  const int channels = std::min(spec.nchannels, 4);
  std::vector<std::uint8_t> stored(static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels));
  if (!picture.input().read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, stored.data())) {
    throw InputError(where, "cannot decode the picture: " + picture.input().geterror());
  }
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.rgba.resize(static_cast<std::size_t>(texels) * 4);
  spreadChannels(stored, channels, image.rgba);
  return image;
}

}  // namespace prelight::images
