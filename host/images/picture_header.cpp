#include "images/picture_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

namespace prelight {

namespace {

// [1] ISO/IEC 15948 (PNG), 11.2.1
// [2] ITU-T T.81 (JPEG), B.1 and B.2
// [3] RFC 9649 (WebP), 2.5 to 2.7
// [4] ISO/IEC 14496-12 (boxes), 4.2, 8.11; ISO/IEC 23008-12 (ispe), 6.5.3
// [5] KTX 2.0, 3
// [6] Ward, "Real Pixels", Graphics Gems II (1991), and the file format of Radiance

struct Magic {
  std::string_view bytes;
  std::size_t offset;
  PictureFormat format;
};

constexpr std::array<Magic, 11> magics = {{{"\x89PNG", 0, PictureFormat::Png},
                                           {"\xFF\xD8\xFF", 0, PictureFormat::Jpeg},
                                           {"WEBP", 8, PictureFormat::WebP},
                                           {"\xABKTX 20", 0, PictureFormat::Ktx2},
                                           {"DDS ", 0, PictureFormat::Dds},
                                           {"BM", 0, PictureFormat::Bmp},
                                           {"GIF8", 0, PictureFormat::Gif},
                                           {{"II*\0", 4}, 0, PictureFormat::Tiff},
                                           {{"MM\0*", 4}, 0, PictureFormat::Tiff},
                                           {"\x76\x2F\x31\x01", 0, PictureFormat::Exr},
                                           {"#?", 0, PictureFormat::Hdr}}};

/// Reads numbers at given places; bytes beyond the end are 0.
class Header {
 public:
  explicit Header(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  std::uint64_t byte(std::size_t at) const { return at < bytes_.size() ? bytes_[at] : 0; }
  std::uint64_t big16(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }
  std::uint64_t big32(std::size_t at) const { return big16(at) << 16 | big16(at + 2); }
  std::uint64_t little16(std::size_t at) const { return byte(at + 1) << 8 | byte(at); }
  std::uint64_t little32(std::size_t at) const { return little16(at + 2) << 16 | little16(at); }
  std::uint64_t little24(std::size_t at) const { return byte(at + 2) << 16 | little16(at); }
  bool has(std::string_view text, std::size_t at) const {
    return at + text.size() <= bytes_.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes_.data()) + at, text.size()) == text;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Reads a PNG's header [1]. Deflate compresses by a factor of at most 1032.
std::optional<PictureExtent> pngExtent(const Header& header) {
  constexpr std::size_t end = 26;
  constexpr std::uint64_t mostRatio = 1032;
  if (header.size() < end || !header.has("IHDR", 12)) return std::nullopt;
  constexpr std::array<std::uint64_t, 7> channelsOfType = {1, 0, 3, 1, 2, 0, 4};
  const std::uint64_t type = header.byte(25);
  const std::uint64_t bits = header.byte(24) * (type < channelsOfType.size() ? channelsOfType[type] : 0);
  PictureExtent extent{header.big32(16), header.big32(20), 0};
  constexpr std::uint64_t longest = 0x7FFFFFFF;
  if (bits == 0 || extent.width > longest || extent.height > longest) return std::nullopt;
  const std::uint64_t rowBytes = (extent.width * bits + 7) / 8;
  // Computed by quotients, because the product could exceed 64 bits.
  extent.leastBytes = rowBytes / mostRatio * extent.height + rowBytes % mostRatio * extent.height / mostRatio;
  return extent;
}

/// Reads the first frame header of a JPEG [2]. A block of 8 x 8 texels takes at least one bit in progressive
/// files; half a bit is required here.
std::optional<PictureExtent> jpegExtent(const Header& header) {
  constexpr std::uint64_t texelsOfByte = 2 * 8 * 64;
  for (std::size_t at = 2; at + 9 < header.size();) {
    if (header.byte(at) != 0xFF) return std::nullopt;
    const std::uint64_t marker = header.byte(at + 1);
    const bool alone = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    if (marker == 0xFF || alone) {
      at += marker == 0xFF ? 1 : 2;
      continue;
    }
    const bool table = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    if (marker >= 0xC0 && marker <= 0xCF && !table) {
      PictureExtent extent{header.big16(at + 7), header.big16(at + 5), 0};
      extent.leastBytes = extent.texels() / texelsOfByte;
      return extent;
    }
    if (marker == 0xD9 || marker == 0xDA || header.big16(at + 2) < 2) return std::nullopt;
    at += 2 + header.big16(at + 2);
  }
  return std::nullopt;
}

/// Reads a WebP's header [3].
std::optional<PictureExtent> webpExtent(const Header& header) {
  constexpr std::size_t end = 30;
  constexpr std::uint64_t low14 = 0x3FFF;
  if (header.size() < 25) return std::nullopt;
  if (header.has("VP8L", 12)) {
    const std::uint64_t bits = header.little24(21) | header.byte(24) << 24;
    return PictureExtent{(bits & low14) + 1, (bits >> 14 & low14) + 1, 0};
  }
  if (header.size() < end) return std::nullopt;
  if (header.has("VP8X", 12)) return PictureExtent{header.little24(24) + 1, header.little24(27) + 1, 0};
  if (header.has("VP8 ", 12))
    return PictureExtent{header.little16(26) & low14, header.little16(28) & low14, 0};
  return std::nullopt;
}

/// Reads a KTX2's header [5].
std::optional<PictureExtent> ktx2Extent(const Header& header) {
  constexpr std::size_t end = 80;
  if (header.size() < end) return std::nullopt;
  return PictureExtent{header.little32(20), header.little32(24), 0};
}

/// Contents [begin, end) of a box of [4].
struct Box {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Calls visit(place of the type, contents) for the boxes in `within`.
template <class Visit>
void forEachBox(const Header& header, const Box& within, Visit visit) {
  constexpr std::size_t headBytes = 8;
  for (std::size_t at = within.begin; at + headBytes <= within.end;) {
    const std::uint64_t stated = header.big32(at);
    const std::uint64_t size = stated == 0 ? within.end - at : stated;
    if (size < headBytes || size > within.end - at) return;
    visit(at + 4, Box{at + headBytes, static_cast<std::size_t>(at + size)});
    at += static_cast<std::size_t>(size);
  }
}

/// Returns whether the brands in the first box [4] include AVIF.
bool isAvif(const Header& header) {
  if (!header.has("ftyp", 4)) return false;
  const std::size_t end = std::min<std::uint64_t>(header.big32(0), header.size());
  constexpr std::size_t majorBrand = 8, minorVersion = 12;
  for (std::size_t at = majorBrand; at + 4 <= end; at += 4) {
    if (at != minorVersion && (header.has("avif", at) || header.has("avis", at))) return true;
  }
  return false;
}

/// Returns the largest of the sizes in the boxes meta, iprp, ipco [4].
std::optional<PictureExtent> avifExtent(const Header& header) {
  constexpr std::size_t versionBytes = 4;
  std::optional<PictureExtent> largest;
  const auto visitProperty = [&](std::size_t type, const Box& box) {
    if (!header.has("ispe", type) || box.end - box.begin < versionBytes + 8) return;
    const PictureExtent extent{header.big32(box.begin + versionBytes),
                               header.big32(box.begin + versionBytes + 4), 0};
    if (!largest || extent.texels() > largest->texels()) largest = extent;
  };
  const auto visitIn = [&](const char* name, auto inner) {
    return [&header, name, inner](std::size_t type, const Box& box) {
      if (header.has(name, type)) forEachBox(header, box, inner);
    };
  };
  const auto visitMeta = [&](std::size_t type, const Box& box) {
    if (header.has("meta", type) && box.end - box.begin >= versionBytes)
      forEachBox(header, {box.begin + versionBytes, box.end},
                 visitIn("iprp", visitIn("ipco", visitProperty)));
  };
  forEachBox(header, {0, header.size()}, visitMeta);
  return largest;
}

/// Reads the numbers of "-Y 4 +X 8", lines and texels per line.
std::optional<std::array<std::uint64_t, 2>> hdrSides(std::string_view line) {
  std::array<std::uint64_t, 2> sides{};
  for (std::uint64_t& side : sides) {
    constexpr std::size_t axis = 3;
    if (line.size() < axis || line[2] != ' ') return std::nullopt;
    line.remove_prefix(axis);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), side);
    if (error != std::errc{} || side > mostPictureTexels) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    while (line.starts_with(' ')) line.remove_prefix(1);
  }
  return sides;
}

/// Reads an HDR's header [6]: lines, an empty one, and the size. A line of texels has four bytes per texel,
/// or four bytes and runs of at most 127 equal bytes for each of four components.
std::optional<PictureExtent> hdrExtent(std::span<const std::uint8_t> bytes) {
  constexpr std::uint64_t longestRun = 127, pixelBytes = 4, runBytes = 2;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t end = text.find("\n\n");
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(end + 2);
  const auto sides = hdrSides(rest.substr(0, rest.find('\n')));
  if (!sides) return std::nullopt;
  const auto [height, width] = *sides;
  const std::uint64_t runs = (width + longestRun - 1) / longestRun;
  return PictureExtent{width, height,
                       height * std::min(pixelBytes * width, pixelBytes * (1 + runBytes * runs))};
}

}  // namespace

PictureFormat pictureFormat(std::span<const std::uint8_t> bytes) {
  const Header header(bytes);
  for (const Magic& magic : magics) {
    if (!header.has(magic.bytes, magic.offset)) continue;
    if (magic.format != PictureFormat::WebP || header.has("RIFF", 0)) return magic.format;
  }
  return isAvif(header) ? PictureFormat::Avif : PictureFormat::Unknown;
}

const char* nameOf(PictureFormat format) {
  constexpr std::array<const char*, 12> names = {
      "an unknown format", "PNG", "JPEG", "WebP", "KTX2", "DDS", "BMP", "GIF", "TIFF", "EXR", "HDR", "AVIF"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<PictureExtent> pictureExtent(std::span<const std::uint8_t> bytes) {
  std::optional<PictureExtent> extent;
  const PictureFormat format = pictureFormat(bytes);
  if (format == PictureFormat::Png) extent = pngExtent(Header(bytes));
  if (format == PictureFormat::Jpeg) extent = jpegExtent(Header(bytes));
  if (format == PictureFormat::WebP) extent = webpExtent(Header(bytes));
  if (format == PictureFormat::Ktx2) extent = ktx2Extent(Header(bytes));
  if (format == PictureFormat::Avif) extent = avifExtent(Header(bytes));
  if (format == PictureFormat::Hdr) extent = hdrExtent(bytes);
  if (extent && extent->texels() == 0) return std::nullopt;
  return extent;
}

}  // namespace prelight
