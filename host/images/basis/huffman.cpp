#include "images/basis/huffman.h"

#include <algorithm>

namespace prelight {

std::uint32_t BitReader::bits(unsigned count) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < count; ++i, ++at_) {
    if (at_ / 8 >= bytes_.size()) {
      broken_ = true;
      return 0;
    }
    value |= std::uint32_t(bytes_[at_ / 8] >> at_ % 8 & 1) << i;
  }
  return value;
}

void HuffmanTable::build(const std::vector<std::uint8_t>& lengths) {
  counts_ = {};
  for (const std::uint8_t length : lengths) ++counts_[length];
  counts_[0] = 0;
  std::array<std::uint32_t, longestCode + 1> next{};
  for (std::size_t i = 1; i < longestCode; ++i) next[i + 1] = next[i] + counts_[i];
  symbols_.assign(next[longestCode] + counts_[longestCode], 0);
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    if (lengths[s] > 0) symbols_[next[lengths[s]]++] = static_cast<std::uint16_t>(s);
  }
}

HuffmanTable::HuffmanTable(BitReader& reader) {
  constexpr std::array<std::uint8_t, 21> order = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
  const std::uint32_t symbols = reader.bits(14);
  if (symbols == 0) return;  // a table that is not used
  const std::uint32_t lengthCodes = reader.bits(5);
  if (lengthCodes == 0 || lengthCodes > order.size()) {
    reader.fail();
    return;
  }
  std::vector<std::uint8_t> lengthLengths(order.size(), 0);
  for (std::uint32_t i = 0; i < lengthCodes; ++i)
    lengthLengths[order[i]] = static_cast<std::uint8_t>(reader.bits(3));
  HuffmanTable lengthTable;
  lengthTable.build(lengthLengths);
  std::vector<std::uint8_t> lengths;
  while (lengths.size() < symbols && !reader.isBroken()) lengthTable.readLengths(reader, symbols, lengths);
  if (!reader.isBroken()) build(lengths);
}

void HuffmanTable::readLengths(BitReader& reader, std::size_t most,
                               std::vector<std::uint8_t>& lengths) const {
  const std::uint32_t code = symbol(reader);
  if (code <= longestCode) return lengths.push_back(static_cast<std::uint8_t>(code));
  // Codes 17 and 18 are runs of zeros, 19 and 20 runs of the previous length.
  const bool repeats = code >= 19;
  const std::uint32_t run = code == 17   ? reader.bits(3) + 3
                            : code == 18 ? reader.bits(7) + 11
                            : code == 19 ? reader.bits(2) + 3
                                         : reader.bits(7) + 7;
  if ((repeats && (lengths.empty() || lengths.back() == 0)) || run > most - lengths.size())
    return reader.fail();
  lengths.insert(lengths.end(), run, repeats ? lengths.back() : std::uint8_t{0});
}

std::uint32_t HuffmanTable::symbol(BitReader& reader) const {
  std::uint32_t code = 0, first = 0, index = 0;
  for (std::size_t length = 1; length <= longestCode; ++length) {
    code |= reader.bits(1);
    if (reader.isBroken()) return 0;
    const std::uint32_t count = counts_[length];
    if (code < first + count) return code < first ? 0 : symbols_[index + (code - first)];
    index += count;
    first = (first + count) << 1;
    code <<= 1;
  }
  reader.fail();
  return 0;
}

}  // namespace prelight
