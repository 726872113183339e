#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace prelight {

enum class PictureFormat : std::uint8_t {
  Unknown,
  Png,
  Jpeg,
  WebP,
  Ktx2,
  Dds,
  Bmp,
  Gif,
  Tiff,
  Exr,
  Hdr,
  Avif
};

/// Returns the format that the first bytes indicate.
PictureFormat pictureFormat(std::span<const std::uint8_t> bytes);

/// Returns a name for messages, such as "PNG" or "an unknown format".
const char* nameOf(PictureFormat format);

/// Size that the header of a PNG, JPEG, WebP, AVIF, KTX2 or HDR picture claims.
struct PictureExtent {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::uint64_t leastBytes = 0;  ///< least size of a file with so many texels, however well they compress

  std::uint64_t texels() const { return width * height; }
};

/// Returns nullopt for other formats and for broken or truncated headers.
std::optional<PictureExtent> pictureExtent(std::span<const std::uint8_t> bytes);

// Limits on decoding, since a header of a few bytes can claim any amount of memory.
constexpr std::uint64_t mostPictureTexels = std::uint64_t{1} << 28;  ///< per picture, 16384 x 16384
constexpr std::uint64_t longestSide = std::uint64_t{1} << 15;

/// Returns the largest number of values (texels x channels) that a floating-point picture in a file of
/// `fileBytes` may have: 2048 x 2048 x RGBA in any file, which takes 64 MB, and beyond that as many as ZIP
/// can compress 16-bit numbers to.
constexpr std::uint64_t mostNumbers(std::uint64_t fileBytes) {
  return (std::uint64_t{1} << 24) + 512 * fileBytes;
}

}  // namespace prelight
