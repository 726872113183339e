#include "scene/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

bool isMissing(const GltfDocument& document, const Json& holder) {
  const auto view = holder.is_object() ? unsignedValue(holder.value("bufferView", Json())) : std::nullopt;
  if (!view || !document.json.contains("bufferViews")) return false;
  const Json& views = document.json.at("bufferViews");
  return *view < views.size() && views[*view].value("buffer", Json()) == missingBuffer;
}

}  // namespace

bool lacksData(const GltfDocument& document, std::size_t accessor) {
  const Json& json = document.json.at("accessors").at(accessor);
  const Json sparse = json.value("sparse", Json::object());
  return isMissing(document, json) || isMissing(document, sparse.value("indices", Json())) ||
         isMissing(document, sparse.value("values", Json()));
}

bool lacksData(const GltfDocument& document, const JsonCursor& primitive) {
  bool lacks = false;
  primitive.at("attributes").forEachMember([&](const JsonCursor& attribute, const std::string&) {
    lacks = lacks || lacksData(document, attribute.asUnsigned());
  });
  const auto indices = primitive.find("indices");
  return lacks || (indices && lacksData(document, indices->asUnsigned()));
}

namespace {

enum ComponentType : int {
  Int8 = 5120,
  Uint8 = 5121,
  Int16 = 5122,
  Uint16 = 5123,
  Uint32 = 5125,
  Float32 = 5126,
};

/// Converts glTF's normalised integers: c / max, and for signed ones max(c / max, -1).
template <class Stored>
float fromNormalized(Stored value) {
  return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0f);
}

/// Returns the number of columns of a square matrix; 0 for other types.
std::size_t columnsOf(const std::string& type) {
  return type.starts_with("MAT") ? static_cast<std::size_t>(type[3] - '0') : 0;
}

/// Returns the accessor after checking it, before any of it is used.
const nlohmann::ordered_json& checkedAccessor(const GltfDocument& document, std::size_t index) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const JsonCursor accessor = root.at("accessors").at(index);
  accessor.expectObject();
  validateAccessor(root, accessor);
  return accessor.value();
}

template <class Stored>
Stored load(const std::uint8_t* bytes) {
  Stored value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

}  // namespace

std::size_t componentBytes(std::uint64_t componentType) {
  switch (componentType) {
    case Int8:
    case Uint8:
      return 1;
    case Int16:
    case Uint16:
      return 2;
    case Uint32:
    case Float32:
      return 4;
    default:
      return 0;
  }
}

std::size_t componentCount(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  if (type == "MAT4") return 16;
  return 0;
}

std::size_t elementBytes(const std::string& type, std::uint64_t componentType) {
  if (const std::size_t columns = columnsOf(type); columns > 0)
    return columns * (columns * componentBytes(componentType) + columnPadding(type, componentType));
  return componentCount(type) * componentBytes(componentType);
}

std::size_t columnPadding(const std::string& type, std::uint64_t componentType) {
  return (4 - columnsOf(type) * componentBytes(componentType) % 4) % 4;
}

AccessorReader::AccessorReader(const GltfDocument& document, std::size_t accessor)
    : document_(document),
      json_(checkedAccessor(document, accessor)),
      type_(json_.at("type").get<std::string>()),
      components_(componentCount(type_)),
      componentType_(json_.at("componentType").get<int>()),
      count_(json_.at("count").get<std::size_t>()),
      normalized_(json_.value("normalized", false)) {
  const std::string file = document.path.string();
  checkSparseIndices(JsonCursor(file, document.json).at("accessors").at(accessor));
}

void AccessorReader::checkSparseIndices(const JsonCursor& accessor) const {
  const std::vector<std::uint32_t> indices = sparseIndices();
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const JsonCursor where = accessor.at("sparse").at("indices");
    if (indices[i] >= count_)
      where.fail(fmt::format("sparse index {} is {}, expected 0..{}", i, indices[i], count_ - 1));
    if (i > 0 && indices[i] <= indices[i - 1])
      where.fail(fmt::format("sparse index {} is {} after {}, expected strictly increasing", i, indices[i],
                             indices[i - 1]));
  }
}

AccessorReader::Source AccessorReader::source(const nlohmann::ordered_json& holder,
                                              std::size_t tightStride) const {
  const auto& view = document_.json.at("bufferViews").at(holder.at("bufferView").get<std::size_t>());
  const std::size_t offset =
      view.value("byteOffset", std::size_t{0}) + holder.value("byteOffset", std::size_t{0});
  return {document_.bin.data() + offset, view.value("byteStride", tightStride)};
}

template <class T, class Stored, class Convert>
std::vector<T> AccessorReader::read(Convert convert) const {
  std::vector<T> values(count_ * components_);
  const std::size_t tight = elementBytes(type_, static_cast<std::uint64_t>(componentType_));
  const std::size_t rows = std::max<std::size_t>(columnsOf(type_), 1);
  const std::size_t padding = columnPadding(type_, static_cast<std::uint64_t>(componentType_));
  const auto copyElement = [&](const std::uint8_t* from, std::size_t element) {
    for (std::size_t c = 0; c < components_; ++c) {
      const std::size_t offset = c * sizeof(Stored) + c / rows * padding;
      values[element * components_ + c] = convert(load<Stored>(from + offset));
    }
  };
  if (json_.contains("bufferView")) {
    const Source from = source(json_, tight);
    for (std::size_t i = 0; i < count_; ++i) copyElement(from.data + i * from.stride, i);
  }
  if (json_.contains("sparse")) {
    const Source from = source(json_.at("sparse").at("values"), tight);
    const std::vector<std::uint32_t> indices = sparseIndices();
    for (std::size_t i = 0; i < indices.size(); ++i) copyElement(from.data + i * tight, indices[i]);
  }
  return values;
}

std::vector<float> AccessorReader::floats(bool forceNormalized) const {
  const auto readIntegers = [&]<class Stored>(Stored) {
    if (normalized_ || forceNormalized)
      return read<float, Stored>([](Stored v) { return fromNormalized(v); });
    return read<float, Stored>([](Stored v) { return static_cast<float>(v); });
  };
  switch (componentType_) {
    case Int8:
      return readIntegers(std::int8_t{});
    case Uint8:
      return readIntegers(std::uint8_t{});
    case Int16:
      return readIntegers(std::int16_t{});
    case Uint16:
      return readIntegers(std::uint16_t{});
    case Uint32:
      return readIntegers(std::uint32_t{});
    default:
      return read<float, float>([](float v) { return v; });
  }
}

std::vector<std::uint32_t> AccessorReader::unsignedIntegers() const {
  const auto widen = [](auto v) { return static_cast<std::uint32_t>(v); };
  switch (componentType_) {
    case Uint8:
      return read<std::uint32_t, std::uint8_t>(widen);
    case Uint16:
      return read<std::uint32_t, std::uint16_t>(widen);
    default:
      return read<std::uint32_t, std::uint32_t>(widen);
  }
}

std::vector<std::uint8_t> AccessorReader::elements() const {
  const std::size_t bytes = elementBytes(type_, static_cast<std::uint64_t>(componentType_));
  // The last element may lack its padding.
  const std::size_t stored = bytes - columnPadding(type_, static_cast<std::uint64_t>(componentType_));
  std::vector<std::uint8_t> values(count_ * bytes, 0);
  if (json_.contains("bufferView")) {
    const Source from = source(json_, bytes);
    for (std::size_t i = 0; i < count_; ++i)
      std::memcpy(&values[i * bytes], from.data + i * from.stride, stored);
  }
  if (json_.contains("sparse")) {
    const Source from = source(json_.at("sparse").at("values"), bytes);
    const std::vector<std::uint32_t> indices = sparseIndices();
    for (std::size_t i = 0; i < indices.size(); ++i)
      std::memcpy(&values[indices[i] * bytes], from.data + i * bytes, stored);
  }
  return values;
}

std::vector<std::uint32_t> AccessorReader::sparseIndices() const {
  if (!json_.contains("sparse")) return {};
  const auto& sparse = json_.at("sparse");
  const auto& indices = sparse.at("indices");
  const auto bytes = componentBytes(indices.at("componentType").get<std::uint64_t>());
  const Source from = source(indices, bytes);
  std::vector<std::uint32_t> values(sparse.at("count").get<std::size_t>());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint8_t* at = from.data + i * bytes;
    values[i] = bytes == 1 ? *at : bytes == 2 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
  }
  return values;
}

}  // namespace prelight
