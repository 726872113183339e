#include "io/plain_exr.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"

namespace prelight {

namespace {

static_assert(std::endian::native == std::endian::little, "as the file's numbers are");

/// The bytes of a file as they grow.
class Bytes {
 public:
  template <typename T>
  void number(T value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
  }

  /// With the NUL that ends it.
  void text(std::string_view text) {
    for (const char c : text) number(c);
    number('\0');
  }

  void attribute(std::string_view name, std::string_view type, std::int32_t size) {
    text(name);
    text(type);
    number(size);
  }

  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  std::size_t size() const { return bytes_.size(); }
  std::span<const std::byte> get() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// In the order of their names, which the format asks for; components of a pixel.
struct Channel {
  char name;
  int component;
};
constexpr std::array<Channel, 3> channels{{{'B', 2}, {'G', 1}, {'R', 0}}};

void writeHeader(const Picture& picture, Bytes& out) {
  constexpr std::int32_t magic = 20000630, version = 2, channelBytes = 18;
  constexpr std::int32_t floatType = 2;
  out.number(magic);
  out.number(version);
  out.attribute("channels", "chlist", channelBytes * std::int32_t{channels.size()} + 1);
  for (const Channel& channel : channels) {
    out.text({&channel.name, 1});
    out.number(floatType);
    out.number(std::int32_t{0});  // linear, reserved
    out.number(std::int32_t{1});  // sampling in x and in y
    out.number(std::int32_t{1});
  }
  out.number('\0');
  out.attribute("compression", "compression", 1);
  out.number(std::uint8_t{0});
  for (const char* window : {"dataWindow", "displayWindow"}) {
    out.attribute(window, "box2i", 16);
    for (const int corner : {0, 0, picture.width - 1, picture.height - 1}) out.number(std::int32_t{corner});
  }
  out.attribute("lineOrder", "lineOrder", 1);
  out.number(std::uint8_t{0});
  out.attribute("pixelAspectRatio", "float", 4);
  out.number(1.0f);
  out.attribute("screenWindowCenter", "v2f", 8);
  out.number(0.0f);
  out.number(0.0f);
  out.attribute("screenWindowWidth", "float", 4);
  out.number(1.0f);
  out.number('\0');
}

}  // namespace

void writePlainExr(const std::filesystem::path& path, const Picture& picture) {
  Bytes out;
  const auto width = static_cast<std::size_t>(picture.width),
             height = static_cast<std::size_t>(picture.height);
  const std::size_t lineBytes = channels.size() * sizeof(float) * width, chunkBytes = 8 + lineBytes;
  out.reserve(1024 + height * (8 + chunkBytes));
  writeHeader(picture, out);
  const std::size_t first = out.size() + 8 * height;
  for (std::size_t y = 0; y < height; ++y) out.number(static_cast<std::uint64_t>(first + y * chunkBytes));
  for (std::size_t y = 0; y < height; ++y) {
    out.number(static_cast<std::int32_t>(y));
    out.number(static_cast<std::int32_t>(lineBytes));
    for (const Channel& channel : channels)
      for (std::size_t x = 0; x < width; ++x) out.number(picture.pixels[y * width + x][channel.component]);
  }
  const std::array<std::span<const std::byte>, 1> pieces{out.get()};
  writeFileAtomically(path, pieces);
}

}  // namespace prelight
