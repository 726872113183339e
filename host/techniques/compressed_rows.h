#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "prelight/transfer.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

/// Compressed SH transfer in a file: what all rows share, and the rows of vertices, texels or cells.
namespace prelight {

/// Rows that follow one another.
struct RowRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The rows of a primitive's vertices, in the order of its instances; row `before` is the scene's first.
std::vector<RowRange> rowsOf(const PrimitiveRanges& ranges, std::size_t before = 0);

/// Method, order, channels, bounces, ranges, means and axes; values are appended to the document.
nlohmann::ordered_json sharedToJson(GltfDocument& document, const CompressedTransfer& transfer);

/// Reads it back, without rows. Throws InputError for what does not fit itself, and for more than
/// `mostChannels` or `mostOrder`.
CompressedTransfer readShared(const ValueReader& values, const JsonCursor& json, int mostChannels = 3,
                              int mostOrder = BakeRequest::maxShOrder);

/// Halves, bytes, clusters and weights of some rows, one after the other.
nlohmann::ordered_json rowsToJson(GltfDocument& document, const CompressedTransfer& transfer,
                                  std::span<const RowRange> rows);

/// Reads them into their places in `transfer`, which has been shared and knows its number of rows. Throws
/// InputError for other numbers of values.
void readRows(const ValueReader& values, const JsonCursor& json, std::span<const RowRange> rows,
              CompressedTransfer& transfer);

/// `count` rows that stand at one place; `transfer` is what they share.
CompressedTransfer readAllRows(const ValueReader& values, const JsonCursor& json, std::size_t count,
                               CompressedTransfer transfer);

/// Other rows of the same, in the order of `rows`.
CompressedTransfer takeRows(const CompressedTransfer& transfer, std::span<const RowRange> rows);

/// What the root's extension says of the rows at `json`. Throws InputError where it does not.
JsonCursor sharedAt(const std::optional<JsonCursor>& extension, const char* member, const JsonCursor& json);

/// Members of all these whose values are accessors, and `others`.
std::vector<std::string_view> compressedAccessors(std::vector<std::string_view> others = {});

/// "cpca:64:8".
std::string methodOf(const CompressedTransfer& transfer);

/// ", as cpca:64:8"; empty for what is not compressed.
std::string compressionText(const std::optional<CompressedTransfer>& transfer);

}  // namespace prelight
