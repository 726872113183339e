#include "images/picture_codecs.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "images/basis/ktx2.h"
#include "images/image_library.h"
#include "images/picture_decoding.h"
#include "prelight/error.h"

namespace prelight {

bool isDecoded(PictureFormat format) {
  return format == PictureFormat::Png || format == PictureFormat::Jpeg || format == PictureFormat::WebP ||
         format == PictureFormat::Avif || format == PictureFormat::Ktx2;
}

void requireDecodable(const PictureExtent& extent, const std::string& where) {
  if (extent.width <= longestSide && extent.height <= longestSide && extent.texels() <= mostPictureTexels)
    return;
  throw InputError(where,
                   fmt::format("a picture of {} x {} texels, expected at most {} along a side and {} in all",
                               extent.width, extent.height, longestSide, mostPictureTexels),
                   "scale the picture down");
}

std::string imageMimeType(std::span<const std::uint8_t> bytes) {
  switch (pictureFormat(bytes)) {
    case PictureFormat::Png:
      return "image/png";
    case PictureFormat::Jpeg:
      return "image/jpeg";
    case PictureFormat::WebP:
      return "image/webp";
    case PictureFormat::Avif:
      return "image/avif";
    case PictureFormat::Ktx2:
      return "image/ktx2";
    case PictureFormat::Dds:
      return "image/vnd-ms.dds";
    case PictureFormat::Bmp:
      return "image/bmp";
    default:
      return {};
  }
}

void checkExtent(std::span<const std::uint8_t> bytes, const std::string& where) {
  const std::optional<PictureExtent> extent = pictureExtent(bytes);
  if (!extent) throw InputError(where, "cannot decode the picture: its header is broken or cut short");
  requireDecodable(*extent, where);
  if (bytes.size() < extent->leastBytes)
    throw InputError(where, fmt::format("cannot decode the picture: {} x {} texels in {} bytes, they take {} "
                                        "at least",
                                        extent->width, extent->height, bytes.size(), extent->leastBytes));
}

Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where) {
  const PictureFormat format = pictureFormat(bytes);
  if (!isDecoded(format)) throw InputError(where, "not a PNG, JPEG, WebP, AVIF or KTX2 picture");
  checkExtent(bytes, where);
  if (format == PictureFormat::Ktx2) return decodeKtx2(bytes, where);
  return decodeTexels(bytes, format, where);
}

std::vector<std::uint8_t> encodePng(const Image& image, PngChannels channels) {
  return imageLibrary().encodePng(image, static_cast<int>(channels));
}

}  // namespace prelight
