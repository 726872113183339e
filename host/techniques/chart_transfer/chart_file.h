#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "prelight/transfer.h"
#include "techniques/compressed_rows.h"
#include "techniques/technique.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Member `texels` of a primitive's entry: the light maps of its instances, in their order; its values are
/// appended to the document. `compressed`, where there, stands for the coefficients of all maps. Null when
/// the transfer has none of the primitive.
nlohmann::ordered_json chartsToJson(GltfDocument& document, const ChartTransfer& transfer,
                                    const std::optional<CompressedTransfer>& compressed,
                                    const CompiledScene& scene, const PrimitiveRanges& ranges);

/// Reads them back, a primitive after the other. Throws InputError when one does not fit the scene, itself or
/// the others.
class ChartReader {
 public:
  /// The input outlives it.
  explicit ChartReader(const BakedInput& input);

  /// Adds the maps of a primitive.
  void read(const JsonCursor& json, const PrimitiveRanges& ranges);

  /// All maps, in the order of the scene's primitives, and their compressed rows where they have such.
  void finish(std::optional<ChartTransfer>& transfer, std::optional<CompressedTransfer>& compressed);

 private:
  void readHeader(const JsonCursor& json);
  void readRowsOf(const JsonCursor& compressed, std::size_t texels);
  void placeCompressed(std::optional<CompressedTransfer>& compressed);

  const BakedInput& input_;
  ValueReader values_;
  std::optional<ChartTransfer> transfer_;
  std::optional<CompressedTransfer> compressed_;  ///< rows in the order of the file
  std::map<std::size_t, RowRange> rows_;          ///< those of a primitive's map
};

}  // namespace prelight
