#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prelight {

/// Reads bits from the lowest bit of the first byte on. Bits beyond the end are 0 and set isBroken().
class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Returns the next `count` bits, at most 32, with the first bit lowest.
  std::uint32_t bits(unsigned count);
  /// Marks the stream as broken.
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
  /// Reads a table. Marks the reader as broken if it is invalid.
  explicit HuffmanTable(BitReader& reader);

  /// Returns the next symbol, or 0 for an invalid code, which marks the reader as broken.
  std::uint32_t symbol(BitReader& reader) const;

 private:
  static constexpr std::size_t longestCode = 16;

  HuffmanTable() = default;
  void build(const std::vector<std::uint8_t>& lengths);
  /// Reads the code length of a symbol, or of a run of symbols, with this table.
  void readLengths(BitReader& reader, std::size_t most, std::vector<std::uint8_t>& lengths) const;

  std::array<std::uint32_t, longestCode + 1> counts_{};  ///< number of codes of each length
  std::vector<std::uint16_t> symbols_;                   ///< symbols in order of their codes
};

}  // namespace prelight
