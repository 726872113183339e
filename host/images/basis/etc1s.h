#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "images/basis/huffman.h"

namespace prelight {

/// Parts of BasisLZ's global data.
struct Etc1sGlobals {
  std::size_t endpointCount = 0;
  std::size_t selectorCount = 0;
  std::span<const std::uint8_t> endpoints;
  std::span<const std::uint8_t> selectors;
  std::span<const std::uint8_t> tables;
};

/// Decoder with the codebooks and tables that all slices of a file share (KTX 2.0, appendix BasisLZ/ETC1S
/// bitstream).
class Etc1sDecoder {
 public:
  explicit Etc1sDecoder(const Etc1sGlobals& globals);

  /// Returns whether the global data is valid.
  bool isUsable() const { return usable_; }

  /// Decodes a slice of blocks of 4 x 4 texels to RGB, [row][column][channel], of `width` x `height` texels.
  /// Returns false when it is broken.
  bool decode(std::span<const std::uint8_t> slice, std::size_t width, std::size_t height,
              std::vector<std::uint8_t>& rgb) const;

 private:
  struct Endpoint {
    std::array<std::uint8_t, 3> color{};  ///< 5 bits per channel
    std::uint8_t table = 0;
  };
  using Selector = std::array<std::uint8_t, 4>;  ///< one byte per row, two bits per texel
  struct SliceTables {
    explicit SliceTables(BitReader& reader)
        : prediction(reader), delta(reader), selector(reader), run(reader), history(reader.bits(13)) {}
    HuffmanTable prediction, delta, selector, run;
    std::size_t history;
  };
  struct Block;
  class SelectorHistory;
  class SliceReader;

  bool readEndpoints(const Etc1sGlobals& globals);
  bool readSelectors(const Etc1sGlobals& globals);

  std::vector<Endpoint> endpoints_;
  std::vector<Selector> selectors_;
  std::unique_ptr<const SliceTables> tables_;
  bool usable_ = false;
};

}  // namespace prelight
