#include "images/basis/ktx2.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "images/basis/etc1s.h"
#include "images/basis/uastc.h"
#include "prelight/error.h"

namespace prelight {

// KTX 2.0, section 3 (file structure) and appendix BasisLZ global data.

namespace {

using Bytes = std::span<const std::uint8_t>;

enum ColorModel : std::uint8_t { ModelEtc1s = 163, ModelUastc = 166 };
enum Supercompression : std::uint32_t { PlainData = 0, BasisLz = 1, Zstandard = 2 };

/// Vulkan formats with one byte per channel.
struct PlainFormat {
  std::uint32_t number;
  std::size_t channels;
  bool blueFirst;
};

constexpr std::array<PlainFormat, 10> plainFormats = {{{9, 1, false},
                                                       {15, 1, false},
                                                       {16, 2, false},
                                                       {22, 2, false},
                                                       {23, 3, false},
                                                       {29, 3, false},
                                                       {30, 3, true},
                                                       {36, 3, true},
                                                       {37, 4, false},
                                                       {43, 4, false}}};

const PlainFormat* plainFormatOf(std::uint64_t number) {
  const auto found = std::find_if(plainFormats.begin(), plainFormats.end(),
                                  [&](const PlainFormat& f) { return f.number == number; });
  return found == plainFormats.end() ? nullptr : &*found;
}

/// Relevant data of a file's index and of its data format descriptor.
struct Ktx2 {
  /// Nullptr for Basis Universal, the only case that uses the last four members.
  const PlainFormat* plain = nullptr;
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t images = 0;  ///< over all levels
  std::uint32_t compression = 0;
  std::uint64_t levelBytes = 0;  ///< decompressed size of the largest level
  Bytes level;
  Bytes globals;
  std::uint8_t model = 0;
  bool isSrgb = false;
  std::size_t samples = 0;
  std::array<std::uint8_t, 2> channels{};  ///< channels of the samples
};

class Ktx2Reader {
 public:
  Ktx2Reader(Bytes bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(where_, "cannot decode the KTX2 picture: " + what, "convert the picture");
  }

  /// Returns a little-endian number of `size` bytes.
  std::uint64_t number(std::uint64_t at, unsigned size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) fail("it is cut short");
    std::uint64_t value = 0;
    for (unsigned i = 0; i < size; ++i) value |= std::uint64_t{bytes_[at + i]} << (8 * i);
    return value;
  }

  Bytes part(std::uint64_t offset, std::uint64_t length) const {
    if (offset > bytes_.size() || length > bytes_.size() - offset) fail("it is cut short");
    return bytes_.subspan(offset, length);
  }

  Ktx2 read() const {
    Ktx2 file;
    file.plain = plainFormatOf(number(12, 4));
    if (file.plain == nullptr && number(12, 4) != 0)
      fail(fmt::format("it has Vulkan's format {}, expected Basis Universal, or 8 bits per channel",
                       number(12, 4)));
    file.width = number(20, 4);
    file.height = number(24, 4);
    const std::uint64_t depth = number(28, 4), layers = number(32, 4), faces = number(36, 4);
    if (file.width == 0 || file.height == 0 || depth > 0 || layers > 1 || faces != 1)
      fail("expected one picture of two dimensions");
    const std::uint64_t levels = std::max<std::uint64_t>(number(40, 4), 1);
    constexpr std::uint64_t mostLevels = 32;
    if (levels > mostLevels) fail(fmt::format("{} levels, expected at most {}", levels, mostLevels));
    file.images = levels;
    file.compression = static_cast<std::uint32_t>(number(44, 4));
    file.globals = part(number(64, 8), number(72, 8));
    file.level = part(number(80, 8), number(88, 8));
    file.levelBytes = number(96, 8);
    if (file.plain == nullptr) readFormat(file, number(48, 4));
    return file;
  }

 private:
  void readFormat(Ktx2& file, std::uint64_t at) const {
    constexpr std::uint64_t headBytes = 28, sampleBytes = 16;
    const std::uint64_t blockBytes = number(at + 10, 2);
    file.model = static_cast<std::uint8_t>(number(at + 12, 1));
    file.isSrgb = number(at + 14, 1) == 2;
    file.samples = blockBytes < headBytes - 4 ? 0 : (blockBytes - (headBytes - 4)) / sampleBytes;
    if (file.samples < 1 || file.samples > 2) fail("its format descriptor is broken");
    for (std::size_t i = 0; i < file.samples; ++i)
      file.channels[i] = static_cast<std::uint8_t>(number(at + headBytes + i * sampleBytes + 3, 1) & 15);
  }

  Bytes bytes_;
  const std::string& where_;
};

/// Decodes two slices: colour and alpha, or red and green.
Image decodeEtc1s(const Ktx2Reader& reader, const Ktx2& file) {
  constexpr std::uint64_t headBytes = 20, imageBytes = 20;
  const auto global = [&](std::uint64_t at, unsigned size) {
    const std::uint64_t begin = static_cast<std::uint64_t>(file.globals.data() - reader.part(0, 0).data());
    if (at + size > file.globals.size()) reader.fail("its global data are cut short");
    return reader.number(begin + at, size);
  };
  std::uint64_t next = headBytes + imageBytes * file.images;
  const auto section = [&](std::uint64_t length) {
    if (next > file.globals.size() || length > file.globals.size() - next)
      reader.fail("its global data are cut short");
    const Bytes bytes = file.globals.subspan(next, length);
    next += length;
    return bytes;
  };
  Etc1sGlobals globals{global(0, 2), global(2, 2), {}, {}, {}};
  globals.endpoints = section(global(4, 4));
  globals.selectors = section(global(8, 4));
  globals.tables = section(global(12, 4));
  const Etc1sDecoder decoder(globals);
  if (!decoder.isUsable()) reader.fail("its codebooks are broken");

  Image image{{}, static_cast<int>(file.width), static_cast<int>(file.height), {}};
  const std::size_t texels = file.width * file.height;
  std::vector<std::uint8_t> rgb(3 * texels);
  const auto decodeSlice = [&](std::uint64_t entry) {
    const std::uint64_t offset = global(entry, 4), length = global(entry + 4, 4);
    if (offset > file.level.size() || length > file.level.size() - offset)
      reader.fail("a slice is cut short");
    if (!decoder.decode(file.level.subspan(offset, length), file.width, file.height, rgb))
      reader.fail("a slice is broken");
  };
  decodeSlice(headBytes + 4);
  image.rgba.resize(4 * texels);
  for (std::size_t i = 0; i < texels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = rgb[3 * i + c];
    image.rgba[4 * i + 3] = 255;
  }
  if (file.samples < 2) return image;
  constexpr std::uint8_t alphaChannel = 15;
  decodeSlice(headBytes + 12);
  for (std::size_t i = 0; i < texels; ++i) {
    const bool isAlpha = file.channels[1] == alphaChannel;
    image.rgba[4 * i + (isAlpha ? 3 : 1)] = rgb[3 * i + 1];
    if (!isAlpha) image.rgba[4 * i + 2] = 0;
  }
  return image;
}

/// Returns the `bytes` of the largest level. If compressed, they are stored in `inflated`.
Bytes levelOf(const Ktx2Reader& reader, const Ktx2& file, std::size_t bytes,
              std::vector<std::uint8_t>& inflated) {
  Bytes level = file.level;
  if (file.compression == Zstandard) {
    if (file.levelBytes != bytes) reader.fail("the size of its level does not fit its texels");
    inflated.resize(bytes);
    const std::size_t got = ZSTD_decompress(inflated.data(), bytes, level.data(), level.size());
    if (ZSTD_isError(got) != 0 || got != bytes) reader.fail("its Zstandard data are broken");
    level = inflated;
  }
  if (level.size() < bytes) reader.fail("it is cut short");
  return level;
}

Image decodePlain(const Ktx2Reader& reader, const Ktx2& file) {
  const std::size_t texels = file.width * file.height, channels = file.plain->channels;
  std::vector<std::uint8_t> inflated;
  const Bytes level = levelOf(reader, file, texels * channels, inflated);
  Image image{{}, static_cast<int>(file.width), static_cast<int>(file.height), {}};
  image.rgba.assign(4 * texels, 0);
  for (std::size_t i = 0; i < texels; ++i) {
    std::uint8_t* texel = &image.rgba[4 * i];
    texel[3] = 255;
    std::copy_n(&level[i * channels], channels, texel);
    if (file.plain->blueFirst) std::swap(texel[0], texel[2]);
  }
  return image;
}

Image decodeBlocks(const Ktx2Reader& reader, const Ktx2& file) {
  const std::size_t blocksX = (file.width + 3) / 4, blocksY = (file.height + 3) / 4;
  const std::size_t bytes = blocksX * blocksY * uastcBlockBytes;
  std::vector<std::uint8_t> inflated;
  const Bytes blocks = levelOf(reader, file, bytes, inflated);
  constexpr std::uint8_t twoChannels = 5;  // red, and green in place of alpha
  Image image{{}, static_cast<int>(file.width), static_cast<int>(file.height), {}};
  image.rgba.resize(4 * file.width * file.height);
  std::array<std::uint8_t, 64> rgba{};
  for (std::size_t b = 0; b < blocksX * blocksY; ++b) {
    decodeUastc(blocks.subspan(b * uastcBlockBytes).first<uastcBlockBytes>(), file.isSrgb, rgba);
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t x = b % blocksX * 4 + i % 4, y = b / blocksX * 4 + i / 4;
      if (x >= file.width || y >= file.height) continue;
      std::uint8_t* texel = &image.rgba[4 * (y * file.width + x)];
      std::copy_n(&rgba[4 * i], 4, texel);
      if (file.channels[0] != twoChannels) continue;
      texel[1] = texel[3];
      texel[2] = 0;
      texel[3] = 255;
    }
  }
  return image;
}

}  // namespace

Image decodeKtx2(Bytes bytes, const std::string& where) {
  const Ktx2Reader reader(bytes, where);
  const Ktx2 file = reader.read();
  const bool isReadable = file.compression == PlainData || file.compression == Zstandard;
  if (file.plain != nullptr && isReadable) return decodePlain(reader, file);
  if (file.plain != nullptr)
    reader.fail(fmt::format("supercompression {}, expected none or Zstandard", file.compression));
  if (file.model == ModelEtc1s && file.compression == BasisLz) return decodeEtc1s(reader, file);
  if (file.model == ModelUastc && isReadable) return decodeBlocks(reader, file);
  reader.fail(
      fmt::format("colour model {} with supercompression {}, expected ETC1S with BasisLZ, or UASTC plain or "
                  "with Zstandard",
                  file.model, file.compression));
}

}  // namespace prelight
