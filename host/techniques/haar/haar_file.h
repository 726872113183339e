#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "io/values/value_reader.h"
#include "techniques/technique.h"

namespace prelight {

/// Wavelet transfer of a primitive's vertices, as member `haar` has it.
/// Where columns become bytes, indices become gaps, and values get a scale per row. `name` is for people.
nlohmann::ordered_json haarToJson(const BakedOutput& output, std::string_view name, const HaarTransfer& haar,
                                  const PrimitiveRanges& ranges);

/// Bytes of it in a file.
std::size_t storedBytes(const HaarTransfer& haar);

/// Reads the sparse rows of all primitives. Vertices of those that have none get empty rows.
class HaarRowsReader {
 public:
  /// `input` outlives it.
  explicit HaarRowsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  /// The first primitive sets the target's face size, channels and bounces.
  void read(const JsonCursor& json, const PrimitiveRanges& ranges, std::optional<HaarTransfer>& target);

  /// After all primitives.
  void finish(HaarTransfer& haar) const;

 private:
  /// A sparse row on its way from file to Bake.
  struct RowPlace {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  /// Reads numbers, or gaps of rows that end at the offsets.
  std::vector<std::uint32_t> readIndices(const JsonCursor& json,
                                         const std::vector<std::uint32_t>& offsets) const;

  const BakedInput& input_;
  ValueReader values_;
  std::vector<RowPlace> rows_;  ///< [vertex * channels + channel], into the pools
  std::vector<std::uint32_t> pooledIndices_;
  std::vector<float> pooledValues_;
};

/// Member `haar` of a primitive's entry.
void writeHaar(const BakedOutput& output, const PrimitiveRanges& ranges, Technique::Json& entry);

std::unique_ptr<TechniqueReader> makeHaarReader(const BakedInput& input);

}  // namespace prelight
