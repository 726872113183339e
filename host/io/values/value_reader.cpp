#include "io/values/value_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/magnitudes.h"
#include "io/values/quantized_column.h"

namespace prelight {

std::optional<JsonCursor> transferExtension(const JsonCursor& object) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(transferExtensionName) : std::nullopt;
}

std::vector<float> ValueReader::floats(const JsonCursor& reference, const char* type,
                                       std::optional<std::size_t> count,
                                       std::span<const std::uint32_t> ends) const {
  std::vector<float> values = reference.value().is_object()
                                  ? readQuantized(*this, reference, type, count, ends)
                                  : open(reference, type, component::float32, count).floats();
  const auto bad =
      std::find_if_not(values.begin(), values.end(), [](float v) { return std::abs(v) <= largestBaked; });
  if (bad != values.end())
    reference.fail(fmt::format("value {} is {}, expected finite numbers of at most {:g}",
                               bad - values.begin(), *bad, largestBaked),
                   rebake);
  return values;
}

ValueReader::StoredBytes ValueReader::storedBytes(const JsonCursor& reference, const char* type,
                                                  std::optional<std::size_t> count) const {
  const AccessorReader stored(document_, reference.asIndex(root_.countOf("accessors"), "accessor"));
  const bool isSigned = stored.componentType() == component::int8;
  return {isSigned, open(reference, type, isSigned ? component::int8 : component::uint8, count).elements()};
}

std::vector<std::uint32_t> ValueReader::shortOrLongIntegers(const JsonCursor& reference) const {
  const AccessorReader reader(document_, reference.asIndex(root_.countOf("accessors"), "accessor"));
  return open(reference, "SCALAR",
              reader.componentType() == component::uint16 ? component::uint16 : component::uint32,
              std::nullopt)
      .unsignedIntegers();
}

AccessorReader ValueReader::open(const JsonCursor& reference, const char* type, int componentType,
                                 std::optional<std::size_t> count) const {
  AccessorReader reader(document_, reference.asIndex(root_.countOf("accessors"), "accessor"));
  if (reader.type() != type || reader.componentType() != componentType) {
    reference.fail(fmt::format("expected an accessor of type {} and component type {}, got {} and {}", type,
                               componentType, reader.type(), reader.componentType()),
                   rebake);
  }
  if (count && reader.count() != *count)
    reference.fail(fmt::format("expected {} values, got {}", *count, reader.count()), rebake);
  return reader;
}

int readNumber(const JsonCursor& json, std::uint64_t least, std::uint64_t most) {
  const std::uint64_t value = json.asUnsigned();
  if (value < least || value > most)
    json.fail(fmt::format("expected {}..{}, got {}", least, most, value), rebake);
  return static_cast<int>(value);
}

int readChannels(const JsonCursor& json) {
  const int channels = readNumber(json.at("channels"), 1, 3);
  if (channels == 2) json.at("channels").fail("expected 1 or 3, got 2", rebake);
  return channels;
}

int readBounces(const JsonCursor& json) {
  return static_cast<int>(std::min<std::uint64_t>(json.unsignedOr("bounces", 0), 1u << 20));
}

std::vector<glm::vec3> readVectors(const ValueReader& reader, const JsonCursor& json,
                                   const PrimitiveRanges& ranges) {
  const std::vector<float> values = reader.floats(json, "VEC3", vertexCount(ranges));
  std::vector<glm::vec3> vectors;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
  return vectors;
}

void expectSame(const JsonCursor& json, bool same, const char* what) {
  if (!same) json.fail(fmt::format("expected the {} of the other primitives", what), rebake);
}

}  // namespace prelight
