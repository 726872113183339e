#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace prelight::test {

/// Appends numbers bit by bit, lowest bit first.
class BitWriter {
 public:
  BitWriter& add(std::uint64_t value, unsigned bits) {
    for (unsigned i = 0; i < bits; ++i, ++count_) {
      if (count_ % 8 == 0) bytes_.push_back(0);
      bytes_.back() |= static_cast<std::uint8_t>((value >> i & 1) << count_ % 8);
    }
    return *this;
  }
  std::vector<std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t count_ = 0;
};

/// Parts of a KTX 2 file with one level.
struct Ktx2Parts {
  std::uint32_t format = 0;  ///< Vulkan's format number.
  std::uint32_t width = 4;
  std::uint32_t height = 4;
  std::uint32_t compression = 0;
  std::uint8_t model = 166;
  bool isSrgb = false;
  std::vector<std::uint8_t> channels = {0};
  std::vector<std::uint8_t> level;
  std::uint64_t levelBytes = 0;
  std::vector<std::uint8_t> globals = {};
};

inline std::vector<std::uint8_t> ktx2File(const Ktx2Parts& parts) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&](std::uint64_t value, unsigned size) {
    for (unsigned i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  constexpr std::string_view identifier = "\xABKTX 20\xBB\r\n\x1A\n";
  bytes.assign(identifier.begin(), identifier.end());
  const std::uint64_t formatAt = 80 + 24;
  const std::uint64_t formatBytes = 4 + 24 + 16 * parts.channels.size();
  const std::uint64_t globalsAt = formatAt + formatBytes;
  const std::uint64_t levelAt = globalsAt + parts.globals.size();
  for (const std::uint64_t number :
       {std::uint64_t{parts.format}, std::uint64_t{1}, std::uint64_t{parts.width},
        std::uint64_t{parts.height}, std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1},
        std::uint64_t{parts.compression}})
    put(number, 4);
  put(formatAt, 4);
  put(formatBytes, 4);
  put(0, 8);
  put(parts.globals.empty() ? 0 : globalsAt, 8);
  put(parts.globals.size(), 8);
  put(levelAt, 8);
  put(parts.level.size(), 8);
  put(parts.levelBytes > 0 ? parts.levelBytes : parts.level.size(), 8);
  put(formatBytes, 4);
  put(0, 4);
  put(2, 2);
  put(formatBytes - 4, 2);
  for (const unsigned byte : {unsigned{parts.model}, 1u, parts.isSrgb ? 2u : 1u, 0u, 3u, 3u, 0u, 0u})
    put(byte, 1);
  put(0, 8);
  for (const std::uint8_t channel : parts.channels) {
    put(0, 3);
    put(channel, 1);
    put(0, 12);
  }
  bytes.insert(bytes.end(), parts.globals.begin(), parts.globals.end());
  bytes.insert(bytes.end(), parts.level.begin(), parts.level.end());
  return bytes;
}

}  // namespace prelight::test
