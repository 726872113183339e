#include "io/values/quantized_column.h"

#include <fmt/format.h>

#include <cmath>

#include "base/magnitudes.h"
#include "compress/small_floats.h"
#include "io/values/baked_ranges.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Reads the scales, and sets how many numbers share one.
void readScales(const ValueReader& values, const JsonCursor& json, std::span<const std::uint32_t> ends,
                QuantizedNumbers& numbers) {
  const auto scales = json.find("scales");
  if (!scales) {
    if (!ends.empty()) json.fail("expected scales, one per row", rebake);
    const double scale = json.numberOr("scale", 1.0);
    if (!(scale > 0.0 && scale <= double(largestBaked)))
      json.at("scale").fail(fmt::format("expected a number above 0, got {}", scale), rebake);
    numbers.form.scale = static_cast<float>(scale);
    return;
  }
  if (json.find("scale")) json.at("scale").fail("expected scale or scales, got both", rebake);
  numbers.scales = values.integers<std::uint16_t>(
      *scales, ends.empty() ? std::nullopt : std::optional<std::size_t>(ends.size()));
  const std::size_t groups = numbers.scales.size();
  if (ends.empty() && (groups == 0 || numbers.bytes.size() % groups != 0))
    scales->fail(fmt::format("{} scales do not divide {} numbers evenly", groups, numbers.bytes.size()),
                 rebake);
  for (const std::uint16_t scale : numbers.scales)
    if (const float value = fromHalf(scale); !(std::isfinite(value) && value >= 0.0f))
      scales->fail(fmt::format("expected finite numbers of at least 0, got {}", value), rebake);
  if (ends.empty()) numbers.form.group = numbers.bytes.size() / groups;
}

}  // namespace

double ColumnSavings::error() const { return squares > 0.0 ? std::sqrt(squaredError / squares) : 0.0; }

Json quantizedToJson(GltfDocument& document, const QuantizedNumbers& numbers, const char* type,
                     std::size_t components) {
  const int bytes = appendAccessor(document, std::as_bytes(std::span(numbers.bytes)), type,
                                   numbers.form.isSigned ? component::int8 : component::uint8,
                                   numbers.bytes.size() / components);
  document.json["accessors"][static_cast<std::size_t>(bytes)]["normalized"] = true;
  Json json = {{"bytes", bytes}};
  if (numbers.form.square) json["square"] = true;
  if (!numbers.scales.empty())
    json["scales"] = appendValues(document, numbers.scales);
  else if (numbers.form.scale != 1.0f)
    json["scale"] = numbers.form.scale;
  return json;
}

std::vector<float> readQuantized(const ValueReader& values, const JsonCursor& json, const char* type,
                                 std::optional<std::size_t> count, std::span<const std::uint32_t> ends) {
  QuantizedNumbers numbers;
  ValueReader::StoredBytes stored = values.storedBytes(json.at("bytes"), type, count);
  numbers.form.isSigned = stored.isSigned;
  numbers.form.square = json.boolOr("square", false);
  numbers.bytes = std::move(stored.bytes);
  if (!ends.empty() && ends.back() > numbers.bytes.size())
    json.at("bytes").fail(fmt::format("{} numbers, but rows have {}", numbers.bytes.size(), ends.back()),
                          rebake);
  readScales(values, json, ends, numbers);
  return dequantize(numbers, ends);
}

Json appendQuantized(GltfDocument& document, std::span<const float> numbers, const ByteForm& form,
                     const char* type, std::size_t components, std::span<const std::uint32_t> ends,
                     ColumnSavings& saved) {
  saved.plainBytes += numbers.size_bytes();
  const std::optional<QuantizedNumbers> quantized = quantize(numbers, form, ends);
  if (!quantized) {
    saved.bytes += numbers.size_bytes();
    return appendValues(document, numbers, type, components);
  }
  saved.bytes += quantized->byteCount();
  const std::vector<float> decoded = dequantize(*quantized, ends);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers[i], error = decoded[i] - number;
    saved.squaredError += error * error;
    saved.squares += number * number;
  }
  return quantizedToJson(document, *quantized, type, components);
}

}  // namespace prelight
