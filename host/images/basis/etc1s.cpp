#include "images/basis/etc1s.h"

#include <algorithm>
#include <utility>

namespace prelight {

namespace {

/// Reads a number in chunks of `chunkBits` bits, lowest first, each followed by a bit that is set if another
/// follows.
std::uint32_t chunkedNumber(BitReader& reader, unsigned chunkBits) {
  std::uint32_t number = 0;
  for (unsigned shift = 0; shift < 32; shift += chunkBits) {
    const std::uint32_t chunk = reader.bits(chunkBits + 1);
    number |= (chunk & ((1u << chunkBits) - 1)) << shift;
    if ((chunk >> chunkBits & 1) == 0) return number;
  }
  reader.fail();
  return 0;
}

}  // namespace

/// Recently used selectors. Selectors that are used again move towards the front.
class Etc1sDecoder::SelectorHistory {
 public:
  explicit SelectorHistory(std::size_t size) : values_(size), rover_(size / 2) {}

  std::size_t size() const { return values_.size(); }
  std::uint32_t use(std::size_t index) {
    const std::uint32_t value = values_[index];
    if (index > 0) std::swap(values_[index / 2], values_[index]);
    return value;
  }
  void add(std::uint32_t value) {
    if (values_.empty()) return;
    values_[rover_++] = value;
    if (rover_ == values_.size()) rover_ = values_.size() / 2;
  }

 private:
  std::vector<std::uint32_t> values_;
  std::size_t rover_;
};

struct Etc1sDecoder::Block {
  std::uint32_t endpoint = 0;
  std::uint32_t selector = 0;
};

/// Reads the blocks of a slice in order.
class Etc1sDecoder::SliceReader {
 public:
  SliceReader(const Etc1sDecoder& decoder, std::span<const std::uint8_t> slice, std::size_t blocksX)
      : decoder_(decoder),
        tables_(*decoder.tables_),
        reader_(slice),
        above_(blocksX),
        current_(blocksX),
        oddRow_((blocksX + 1) / 2),
        history_(tables_.history) {}

  /// Reads block (x, y). Returns false when the slice is broken.
  bool read(std::size_t x, std::size_t y, Block& block) {
    if (x == 0) std::swap(above_, current_);
    if (x % 2 == 0) readPredictions(x, y);
    if (!readEndpoint(x, y, block.endpoint) || !readSelector(block.selector)) return false;
    current_[x] = block.endpoint;
    last_ = block.endpoint;
    return !reader_.isBroken();
  }

 private:
  /// Reads two bits for each block of a 2 x 2 group; called in even rows.
  void readPredictions(std::size_t x, std::size_t y) {
    constexpr std::uint32_t repeatSymbol = 256;
    constexpr std::uint32_t leastRepeats = 3;
    if (y % 2 == 1) {
      predictions_ = oddRow_[x / 2];
      return;
    }
    if (repeats_ > 0) {
      --repeats_;
    } else if (const std::uint32_t symbol = tables_.prediction.symbol(reader_); symbol == repeatSymbol) {
      repeats_ = chunkedNumber(reader_, 4) + leastRepeats - 1;
    } else {
      lastPredictions_ = symbol;
    }
    predictions_ = lastPredictions_;
    oddRow_[x / 2] = predictions_ >> 4;
  }

  bool readEndpoint(std::size_t x, std::size_t y, std::uint32_t& endpoint) {
    enum Prediction : std::uint32_t { Left = 0, Above = 1, AboveLeft = 2 };
    const std::uint32_t prediction = predictions_ & 3;
    predictions_ >>= 2;
    const bool needsLeft = prediction == Left || prediction == AboveLeft;
    const bool needsAbove = prediction == Above || prediction == AboveLeft;
    if ((needsLeft && x == 0) || (needsAbove && y == 0)) return false;
    if (prediction == Left) {
      endpoint = last_;
    } else if (prediction == Above) {
      endpoint = above_[x];
    } else if (prediction == AboveLeft) {
      endpoint = above_[x - 1];
    } else {
      const auto count = static_cast<std::uint32_t>(decoder_.endpoints_.size());
      endpoint = tables_.delta.symbol(reader_) + last_;
      if (endpoint >= count) endpoint -= count;
    }
    return endpoint < decoder_.endpoints_.size();
  }

  bool readSelector(std::uint32_t& selector) {
    const auto count = static_cast<std::uint32_t>(decoder_.selectors_.size());
    const auto runSymbol = static_cast<std::uint32_t>(count + history_.size());
    constexpr std::uint32_t leastRun = 3;
    constexpr std::uint32_t longRun = 63;
    std::uint32_t symbol = count;
    if (run_ > 0) {
      --run_;
    } else {
      symbol = tables_.selector.symbol(reader_);
      if (symbol == runSymbol) {
        const std::uint32_t length = tables_.run.symbol(reader_);
        run_ = (length == longRun ? chunkedNumber(reader_, 7) : length) + leastRun - 1;
        symbol = count;
      }
    }
    if (symbol < count) {
      selector = symbol;
      history_.add(selector);
      return true;
    }
    if (symbol - count >= history_.size()) return false;
    selector = history_.use(symbol - count);
    return selector < count;
  }

  const Etc1sDecoder& decoder_;
  const SliceTables& tables_;
  BitReader reader_;
  std::vector<std::uint32_t> above_;
  std::vector<std::uint32_t> current_;
  std::vector<std::uint32_t> oddRow_;
  SelectorHistory history_;
  std::uint32_t predictions_ = 0;
  std::uint32_t lastPredictions_ = 0;
  std::uint32_t repeats_ = 0;
  std::uint32_t run_ = 0;
  std::uint32_t last_ = 0;
};

Etc1sDecoder::Etc1sDecoder(const Etc1sGlobals& globals) {
  BitReader reader(globals.tables);
  tables_ = std::make_unique<const SliceTables>(reader);
  usable_ = !reader.isBroken() && readEndpoints(globals) && readSelectors(globals);
}

bool Etc1sDecoder::readEndpoints(const Etc1sGlobals& globals) {
  BitReader reader(globals.endpoints);
  const std::array<HuffmanTable, 3> colorDeltas = {HuffmanTable(reader), HuffmanTable(reader),
                                                   HuffmanTable(reader)};
  const HuffmanTable tableDelta(reader);
  const bool isGrey = reader.bits(1) == 1;
  Endpoint last{{16, 16, 16}, 0};
  for (std::size_t i = 0; i < globals.endpointCount && !reader.isBroken(); ++i) {
    last.table = static_cast<std::uint8_t>((last.table + tableDelta.symbol(reader)) & 7);
    for (std::size_t c = 0; c < (isGrey ? 1 : 3); ++c) {
      const std::size_t model = last.color[c] <= 9 ? 0 : last.color[c] <= 21 ? 1 : 2;
      last.color[c] = static_cast<std::uint8_t>((last.color[c] + colorDeltas[model].symbol(reader)) & 31);
    }
    if (isGrey) last.color[1] = last.color[2] = last.color[0];
    endpoints_.push_back(last);
  }
  return !reader.isBroken() && !endpoints_.empty();
}

bool Etc1sDecoder::readSelectors(const Etc1sGlobals& globals) {
  BitReader reader(globals.selectors);
  if (reader.bits(2) != 0) return false;
  const bool isPlain = reader.bits(1) == 1;
  std::unique_ptr<const HuffmanTable> deltas;
  if (!isPlain) deltas = std::make_unique<const HuffmanTable>(reader);
  Selector last{};
  for (std::size_t i = 0; i < globals.selectorCount && !reader.isBroken(); ++i) {
    for (std::uint8_t& row : last)
      row = static_cast<std::uint8_t>(isPlain || i == 0 ? reader.bits(8) : deltas->symbol(reader) ^ row);
    selectors_.push_back(last);
  }
  return !reader.isBroken() && !selectors_.empty();
}

bool Etc1sDecoder::decode(std::span<const std::uint8_t> slice, std::size_t width, std::size_t height,
                          std::vector<std::uint8_t>& rgb) const {
  // ETC1's modifiers by selector (Khronos Data Format, ETC1).
  constexpr std::array<std::array<int, 4>, 8> modifiers = {{{-8, -2, 2, 8},
                                                            {-17, -5, 5, 17},
                                                            {-29, -9, 9, 29},
                                                            {-42, -13, 13, 42},
                                                            {-60, -18, 18, 60},
                                                            {-80, -24, 24, 80},
                                                            {-106, -33, 33, 106},
                                                            {-183, -47, 47, 183}}};
  const std::size_t blocksX = (width + 3) / 4;
  const std::size_t blocksY = (height + 3) / 4;
  SliceReader reader(*this, slice, blocksX);
  for (std::size_t y = 0; y < blocksY; ++y) {
    for (std::size_t x = 0; x < blocksX; ++x) {
      Block block;
      if (!reader.read(x, y, block)) return false;
      const Endpoint& endpoint = endpoints_[block.endpoint];
      for (std::size_t ty = 4 * y; ty < std::min(4 * y + 4, height); ++ty) {
        for (std::size_t tx = 4 * x; tx < std::min(4 * x + 4, width); ++tx) {
          const unsigned selector = selectors_[block.selector][ty % 4] >> (2 * (tx % 4)) & 3;
          for (std::size_t c = 0; c < 3; ++c) {
            const int base = endpoint.color[c] << 3 | endpoint.color[c] >> 2;
            rgb[3 * (ty * width + tx) + c] =
                static_cast<std::uint8_t>(std::clamp(base + modifiers[endpoint.table][selector], 0, 255));
          }
        }
      }
    }
  }
  return true;
}

}  // namespace prelight
