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

/// The format that the first bytes tell.
PictureFormat pictureFormat(std::span<const std::uint8_t> bytes);

/// "PNG", for messages; "an unknown format".
const char* nameOf(PictureFormat format);

/// What the header of a PNG, JPEG, WebP, AVIF or KTX2 picture claims.
struct PictureExtent {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::uint64_t leastBytes = 0;  ///< a file of fewer cannot hold so many texels, however well they compress

  std::uint64_t texels() const { return width * height; }
};

/// nullopt for other formats and where the header is broken or cut short.
std::optional<PictureExtent> pictureExtent(std::span<const std::uint8_t> bytes);

// Limits of what is decoded, since a header of a few bytes can ask for any amount of memory.
constexpr std::uint64_t mostTexels = std::uint64_t{1} << 28;  ///< of a picture, 16384 x 16384
constexpr std::uint64_t longestSide = std::uint64_t{1} << 15;

/// Numbers, that is texels x channels, that a picture in floats of a file of so many bytes may have: 8192 x
/// 2730 x RGB in any file; beyond, what 16-bit numbers can be compressed to by ZIP.
constexpr std::uint64_t mostNumbers(std::uint64_t fileBytes) {
  return (std::uint64_t{1} << 26) + 512 * fileBytes;
}

}  // namespace prelight
