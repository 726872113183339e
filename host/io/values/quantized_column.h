#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compress/quantized_numbers.h"
#include "io/values/value_reader.h"
#include "scene/gltf/gltf_document.h"

/// A column of floats that a file stores as bytes: an object with accessors in place of the accessor of
/// floats.
///
///   bytes    BYTE or UNSIGNED_BYTE, normalised, with as many elements as the floats have
///   square   true: numbers are t |t| instead of t
///   scales   SCALAR uint16, halves: numbers are multiplied by the scale of their group, and all groups are
///            equally long unless the column says otherwise
///   scale    a factor of all numbers; absent with `scales`, or where it is 1
///
/// Ascending indices of sparse rows are an object with `gaps` (encodeGaps()).
namespace prelight {

/// Members of these objects whose values are accessors.
inline constexpr std::string_view quantizedAccessors[] = {"bytes", "scales", "gaps"};

/// Size and error of a column in bytes, summed over a scene's primitives.
struct ColumnSavings {
  std::size_t plainBytes = 0;  ///< of the numbers as they are stored otherwise
  std::size_t bytes = 0;
  double squaredError = 0.0;
  double squares = 0.0;  ///< sum of the squared numbers

  /// Returns the RMS of the errors over that of the numbers.
  double error() const;
};

/// Savings by the column's name for people.
using SavingsByColumn = std::map<std::string, ColumnSavings, std::less<>>;

/// Appends numbers and returns the object that refers to them. `components` are those of glTF's `type`.
nlohmann::ordered_json quantizedToJson(GltfDocument& document, const QuantizedNumbers& numbers,
                                       const char* type, std::size_t components);

/// Reads a column of bytes, see ValueReader::floats(). Throws InputError for what does not fit itself.
std::vector<float> readQuantized(const ValueReader& values, const JsonCursor& json, const char* type,
                                 std::optional<std::size_t> count, std::span<const std::uint32_t> ends);

/// Appends numbers as bytes if they can be, else as floats, and returns what refers to them. `saved` counts
/// bytes.
nlohmann::ordered_json appendQuantized(GltfDocument& document, std::span<const float> numbers,
                                       const ByteForm& form, const char* type, std::size_t components,
                                       std::span<const std::uint32_t> ends, ColumnSavings& saved);

}  // namespace prelight
