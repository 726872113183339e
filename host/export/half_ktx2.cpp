#include "export/half_ktx2.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "compress/small_floats.h"

namespace prelight {

namespace {

constexpr std::array<std::uint8_t, 12> identifier = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                                                     0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
constexpr std::uint32_t rgbaHalf = 97;  // VK_FORMAT_R16G16B16A16_SFLOAT
constexpr std::size_t headerBytes = 80, levelIndexBytes = 24, texelBytes = 8;

/// Appends values to a file in little-endian order.
class Bytes {
 public:
  std::vector<std::uint8_t> data;

  template <class T>
  void add(T value) {
    for (std::size_t shift = 0; shift < 8 * sizeof(T); shift += 8)
      data.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> shift));
  }

  void add(std::string_view text) {
    data.insert(data.end(), text.begin(), text.end());
    data.push_back(0);
  }

  void align(std::size_t to) { data.resize((data.size() + to - 1) / to * to, 0); }
};

/// Returns the descriptor: Khronos Data Format 1.3, basic block of four signed float samples, linear light,
/// BT.709 primaries.
std::vector<std::uint8_t> formatDescriptor() {
  constexpr std::uint32_t samples = 4, blockBytes = 24 + 16 * samples;
  constexpr std::uint8_t rgbsda = 1, bt709 = 1, linear = 1, signedFloat = 0xC0;
  constexpr std::array<std::uint8_t, samples> channels = {0, 1, 2, 15};
  Bytes bytes;
  bytes.add(4 + blockBytes);
  bytes.add(std::uint32_t{0});  // vendor Khronos, basic descriptor
  bytes.add(std::uint16_t{2});  // version 1.3
  bytes.add(static_cast<std::uint16_t>(blockBytes));
  for (const std::uint8_t value : {rgbsda, bt709, linear, std::uint8_t{0}}) bytes.add(value);
  bytes.add(std::uint32_t{0});  // blocks of one texel
  bytes.add(static_cast<std::uint64_t>(texelBytes));
  for (std::uint32_t i = 0; i < samples; ++i) {
    bytes.add(static_cast<std::uint16_t>(16 * i));
    bytes.add(std::uint8_t{15});  // bits minus one
    bytes.add(static_cast<std::uint8_t>(signedFloat | channels[i]));
    bytes.add(std::uint32_t{0});
    bytes.add(std::bit_cast<std::uint32_t>(-1.0f));
    bytes.add(std::bit_cast<std::uint32_t>(1.0f));
  }
  return bytes.data;
}

/// Returns pairs of keys and values, each padded to 4 bytes.
std::vector<std::uint8_t> keyValues() {
  Bytes bytes;
  for (const auto& [key, value] :
       {std::pair<std::string_view, std::string_view>{"KTXorientation", "rd"}, {"KTXwriter", "Prelight"}}) {
    bytes.add(static_cast<std::uint32_t>(key.size() + value.size() + 2));
    bytes.add(key);
    bytes.add(value);
    bytes.align(4);
  }
  return bytes.data;
}

}  // namespace

std::vector<std::uint8_t> encodeHalfKtx2(const Picture& picture) {
  const std::vector<std::uint8_t> format = formatDescriptor(), keys = keyValues();
  const std::size_t formatAt = headerBytes + levelIndexBytes, keysAt = formatAt + format.size();
  const std::size_t levelAt = (keysAt + keys.size() + texelBytes - 1) / texelBytes * texelBytes;
  const std::uint64_t levelBytes = texelBytes * picture.pixels.size();
  Bytes bytes;
  bytes.data.assign(identifier.begin(), identifier.end());
  for (const std::uint32_t word :
       {rgbaHalf, 2u, static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height),
        0u, 0u, 1u, 1u, 0u, static_cast<std::uint32_t>(formatAt), static_cast<std::uint32_t>(format.size()),
        static_cast<std::uint32_t>(keysAt), static_cast<std::uint32_t>(keys.size())})
    bytes.add(word);
  bytes.add(std::uint64_t{0});  // no global data
  bytes.add(std::uint64_t{0});
  bytes.add(static_cast<std::uint64_t>(levelAt));
  bytes.add(levelBytes);
  bytes.add(levelBytes);
  bytes.data.insert(bytes.data.end(), format.begin(), format.end());
  bytes.data.insert(bytes.data.end(), keys.begin(), keys.end());
  bytes.align(texelBytes);
  for (const glm::vec3& pixel : picture.pixels) {
    for (int c = 0; c < 3; ++c) bytes.add(toHalf(std::clamp(pixel[c], -halfMax, halfMax)));
    bytes.add(toHalf(1.0f));
  }
  return bytes.data;
}

}  // namespace prelight
