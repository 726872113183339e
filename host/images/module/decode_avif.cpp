#include <avif/avif.h>

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
  decoder->imageSizeLimit = static_cast<std::uint32_t>(mostTexels);
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

}  // namespace prelight::images
