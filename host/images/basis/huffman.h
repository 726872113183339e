#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prelight {

/// Bits from the lowest of the first byte on. Beyond the end they are 0, and isBroken() says so.
class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// The next `count` bits, at most 32, the first of them lowest.
  std::uint32_t bits(unsigned count);
  /// Nothing more can be read of use.
  void fail() { broken_ = true; }
  bool isBroken() const { return broken_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;  ///< in bits
  bool broken_ = false;
};

/// A table of canonical Huffman codes as BasisLZ stores them (KTX 2.0, appendix BasisLZ/ETC1S bitstream).
class HuffmanTable {
 public:
  /// Reads a table; the reader is broken when there is none.
  explicit HuffmanTable(BitReader& reader);

  /// The next symbol; 0 where the code is none, and the reader is broken.
  std::uint32_t symbol(BitReader& reader) const;

 private:
  static constexpr std::size_t longestCode = 16;

  HuffmanTable() = default;
  void build(const std::vector<std::uint8_t>& lengths);
  /// Reads the code of one length, or of a run of them, by this table of such codes.
  void readLengths(BitReader& reader, std::size_t most, std::vector<std::uint8_t>& lengths) const;

  std::array<std::uint32_t, longestCode + 1> counts_{};  ///< codes of each length
  std::vector<std::uint16_t> symbols_;                   ///< by code
};

}  // namespace prelight
