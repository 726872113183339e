#include "images/picture_decoding.h"

#include <optional>
#include <utility>

#include "images/exr.h"
#include "images/image_library.h"
#include "images/picture_jobs.h"
#include "images/plain_png.h"
#include "sandbox/decoder.h"

namespace prelight {

namespace {

/// A picture to decode.
struct Encoded {
  std::span<const std::uint8_t> bytes;
  PictureFormat format;
  const std::string& where;
};

/// Returns what a process without rights makes of a picture, or, where there is none, what `here` returns.
template <typename Here>
auto decodeApart(DecoderJob job, const Encoded& picture, Here here) -> decltype(here()) {
  const auto session = DecoderSession::begin(job);
  if (!session) return here();
  decltype(here()) result;
  session->ask(
      picture.where,
      [&](JobSocket& socket) { putRequest(socket, picture.format, picture.where, picture.bytes); },
      [&](JobSocket& socket) { getResult(socket, result); });
  return result;
}

}  // namespace

Pixels decodePixels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where) {
  const Encoded picture{bytes, format, where};
  if (format == PictureFormat::Exr)
    if (std::optional<Pixels> plain =
            decodeApart(DecoderJob::PlainExr, picture, [&] { return decodePlainExr(bytes); }))
      return *std::move(plain);
  return decodeApart(DecoderJob::Pixels, picture,
                     [&] { return imageLibrary().decodePixels(bytes, format, where); });
}

PictureLayers decodeLayers(std::span<const std::uint8_t> bytes, const std::string& where) {
  return decodeApart(DecoderJob::Layers, {bytes, PictureFormat::Exr, where},
                     [&] { return imageLibrary().decodeLayers(bytes, where); });
}

Image decodeTexels(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where) {
  const Encoded picture{bytes, format, where};
  if (format == PictureFormat::Png)
    if (std::optional<Image> plain =
            decodeApart(DecoderJob::PlainPng, picture, [&] { return decodePlainPng(bytes); }))
      return *std::move(plain);
  return decodeApart(DecoderJob::Image, picture,
                     [&] { return imageLibrary().decodeImage(bytes, format, where); });
}

}  // namespace prelight
