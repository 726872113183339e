#include "materials/plain_png.h"

#include <algorithm>
#include <string_view>

namespace prelight::test {

namespace {

using Bytes = std::vector<std::uint8_t>;

void appendBigEndian(Bytes& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// CRC-32 with the polynomial of ISO 3309, bit by bit.
std::uint32_t checksum(const Bytes& bytes, std::size_t from) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = from; i < bytes.size(); ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0u ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

void appendChunk(Bytes& to, std::string_view kind, const Bytes& data) {
  appendBigEndian(to, static_cast<std::uint32_t>(data.size()));
  const std::size_t from = to.size();
  to.insert(to.end(), kind.begin(), kind.end());
  to.insert(to.end(), data.begin(), data.end());
  appendBigEndian(to, checksum(to, from));
}

/// A zlib stream of stored (uncompressed) blocks.
Bytes stored(const Bytes& data) {
  constexpr std::size_t most = 65535;
  Bytes out = {0x78, 0x01};
  std::uint32_t a = 1, b = 0;  // Adler-32.
  for (std::size_t at = 0; at < data.size(); at += most) {
    const std::size_t size = std::min(most, data.size() - at);
    out.push_back(at + size == data.size() ? 1 : 0);
    for (const std::size_t value : {size, size ^ 0xFFFFu})
      for (const int shift : {0, 8}) out.push_back(static_cast<std::uint8_t>(value >> shift));
    for (std::size_t i = at; i < at + size; ++i) {
      out.push_back(data[i]);
      a = (a + data[i]) % 65521u;
      b = (b + a) % 65521u;
    }
  }
  appendBigEndian(out, (b << 16) | a);
  return out;
}

}  // namespace

std::vector<std::uint8_t> plainPng(const Image& image) {
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  Bytes header;
  appendBigEndian(header, static_cast<std::uint32_t>(image.width));
  appendBigEndian(header, static_cast<std::uint32_t>(image.height));
  header.insert(header.end(), {8, 6, 0, 0, 0});  // 8 bits, RGBA.
  appendChunk(png, "IHDR", header);
  const auto row = static_cast<std::ptrdiff_t>(4 * image.width);
  Bytes rows;
  for (std::ptrdiff_t y = 0; y < image.height; ++y) {
    rows.push_back(0);  // No filter.
    rows.insert(rows.end(), image.rgba.begin() + y * row, image.rgba.begin() + (y + 1) * row);
  }
  appendChunk(png, "IDAT", stored(rows));
  appendChunk(png, "IEND", {});
  return png;
}

}  // namespace prelight::test
