#include "images/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "images/picture_header.h"
#include "prelight/error.h"

namespace prelight {

namespace {

// OpenEXR File Layout: version field, headers, attribute layout, offset tables.
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

constexpr std::uint32_t multiPartFlag = 0x1000;
constexpr std::size_t longestName = 255;
constexpr std::uint64_t offsetBytes = 8;
/// Lines per chunk of the compressions: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA and DWAB.
constexpr std::array<std::uint64_t, 10> linesPerChunk = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
constexpr std::uint64_t channelBytes = 16;  ///< of a channel's description behind its name

struct AttributeType {
  std::string_view name;
  std::size_t bytes;
};
/// Types of one size: the library reads as many bytes, whatever the header says.
constexpr std::array<AttributeType, 23> sizedTypes = {{
    {"box2i", 16},
    {"box2f", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3f", 12},
    {"v3i", 12},
}};
constexpr std::size_t previewHeaderBytes = 8, previewPixelBytes = 4;

/// The claims of a part's header.
struct ExrPartHeader {
  std::uint64_t width = 0, height = 0;
  std::uint64_t channels = 0;
  std::uint64_t lines = 1;                      ///< per chunk
  std::uint64_t tileWidth = 0, tileHeight = 0;  ///< 0: no tiles
  std::uint64_t chunks = 0;                     ///< of attribute chunkCount; 0: there is none

  std::uint64_t texels() const { return width * height; }

  /// Returns the least number of chunks: without the smaller levels of tiled parts.
  std::uint64_t leastChunks() const {
    const auto parts = [](std::uint64_t whole, std::uint64_t part) { return (whole + part - 1) / part; };
    if (tileWidth == 0 || tileHeight == 0) return std::max(chunks, parts(height, lines));
    return std::max(chunks, parts(width, tileWidth) * parts(height, tileHeight));
  }
};

class ExrHeaderReader {
 public:
  explicit ExrHeaderReader(const std::filesystem::path& path)
      : where_(path.string()), file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

  void check() {
    std::array<std::uint32_t, 2> begin{};  // magic number, version and flags
    read(begin.data(), sizeof begin);
    const bool multiPart = (begin[1] & multiPartFlag) != 0;
    std::uint64_t numbers = 0, chunks = 0;
    while (const std::optional<ExrPartHeader> part = readPart()) {
      checkWindow(*part);
      numbers += part->texels() * part->channels;
      chunks += part->leastChunks();
      checkClaims(numbers, chunks);
      if (!multiPart) break;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(where_, "cannot be read as a picture: " + what,
                     "the file is damaged, or write it again");
  }

  std::uint64_t left() { return size_ - static_cast<std::uint64_t>(file_.tellg()); }

  void read(void* target, std::size_t bytes) {
    if (!file_.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes)))
      fail("its header is cut short");
  }

  template <typename T>
  T number(const std::vector<char>& value, std::size_t at) const {
    T number{};
    if (value.size() < at + sizeof number) fail("an attribute of its header is too short");
    std::memcpy(&number, value.data() + at, sizeof number);
    return number;
  }

  /// Reads a text that a zero byte ends.
  std::string readName() {
    std::string name;
    for (char c = 0;; name += c) {
      read(&c, 1);
      if (c == '\0') return name;
      if (name.size() == longestName) fail("its header has a name without end");
    }
  }

  /// Reads the attributes of a part. Returns nullopt where the list of headers ends.
  std::optional<ExrPartHeader> readPart() {
    std::string name = readName();
    if (name.empty()) return std::nullopt;
    ExrPartHeader part;
    for (; !name.empty(); name = readName()) {
      const std::string type = readName();
      std::int32_t bytes = 0;
      read(&bytes, sizeof bytes);
      if (bytes < 0 || static_cast<std::uint64_t>(bytes) > left())
        fail(fmt::format("attribute \"{}\" of its header claims {} bytes, and {} are left", name, bytes,
                         left()));
      takeAttribute(name, type, static_cast<std::size_t>(bytes), part);
    }
    return part;
  }

  /// Returns the size of a preview by its own width and height.
  std::uint64_t previewBytes(const std::vector<char>& value) const {
    const std::uint64_t width = number<std::uint32_t>(value, 0), height = number<std::uint32_t>(value, 4);
    if (std::max(width, height) > value.size() && std::min(width, height) > 0)
      fail("its preview is cut short");  // before the product overflows
    return previewHeaderBytes + previewPixelBytes * width * height;
  }

  /// Requires that a value has the size by which the library reads it. Otherwise the two would read what
  /// follows differently.
  void checkSize(const std::string& name, const std::string& type, const std::vector<char>& value) const {
    std::uint64_t expected = value.size();
    const auto sized = std::ranges::find(sizedTypes, type, &AttributeType::name);
    if (sized != sizedTypes.end()) expected = sized->bytes;
    if (type == "preview") expected = previewBytes(value);
    if (type == "chlist") expected = channelsIn(value).bytes;
    if (expected != value.size())
      fail(fmt::format("attribute \"{}\" of its header has {} bytes, expected {} of a {}", name, value.size(),
                       expected, type));
  }

  void takeAttribute(const std::string& name, const std::string& type, std::size_t bytes,
                     ExrPartHeader& part) {
    std::vector<char> value(bytes);
    read(value.data(), bytes);
    checkSize(name, type, value);
    if (name == "dataWindow") {
      const auto side = [&](std::size_t low) {
        const std::int64_t length =
            std::int64_t{number<std::int32_t>(value, low + 8)} - number<std::int32_t>(value, low) + 1;
        return length < 0 ? 0 : static_cast<std::uint64_t>(length);
      };
      part.width = side(0);
      part.height = side(4);
    } else if (name == "compression") {
      const auto kind = number<std::uint8_t>(value, 0);
      part.lines = kind < linesPerChunk.size() ? linesPerChunk[kind] : 1;
    } else if (name == "tiles") {
      part.tileWidth = number<std::uint32_t>(value, 0);
      part.tileHeight = number<std::uint32_t>(value, 4);
    } else if (name == "chunkCount") {
      part.chunks = number<std::uint32_t>(value, 0);
    } else if (name == "channels") {
      part.channels = channelsIn(value).count;
    }
  }

  struct ChannelList {
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;  ///< with the zero byte that ends it
  };
  ChannelList channelsIn(const std::vector<char>& list) const {
    ChannelList channels;
    std::size_t at = 0;
    for (; number<char>(list, at) != '\0'; ++channels.count) {
      while (number<char>(list, at) != '\0') ++at;
      at += 1 + channelBytes;
    }
    channels.bytes = at + 1;
    return channels;
  }

  void checkWindow(const ExrPartHeader& part) const {
    const std::uint64_t longer = std::max(part.width, part.height);
    if (part.texels() == 0 || longer > mostPictureTexels || part.texels() > mostPictureTexels)
      fail(fmt::format("its header claims {} x {} texels, expected 1 to {}", part.width, part.height,
                       mostPictureTexels));
  }

  void checkClaims(std::uint64_t numbers, std::uint64_t chunks) const {
    if (numbers > mostNumbers(size_))
      fail(fmt::format("its header claims {} numbers in {} bytes, expected at most {}", numbers, size_,
                       mostNumbers(size_)));
    if (chunks > size_ / offsetBytes)
      fail(fmt::format("its header claims {} chunks of pixels in {} bytes", chunks, size_));
  }

  std::string where_;
  std::ifstream file_;
  std::uint64_t size_;
};

}  // namespace

void checkExrHeaders(const std::filesystem::path& path) { ExrHeaderReader(path).check(); }

}  // namespace prelight
