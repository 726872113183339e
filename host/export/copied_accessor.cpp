#include "export/copied_accessor.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

int appendVertexAccessor(GltfDocument& document, Json accessor, std::span<const std::uint8_t> bytes,
                         std::size_t stride) {
  const int view = appendBufferView(document, bytes);
  document.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = stride;
  accessor["bufferView"] = view;
  document.json["accessors"].push_back(std::move(accessor));
  return static_cast<int>(document.json["accessors"].size()) - 1;
}

/// Returns the selected elements as the file stores them.
std::vector<std::uint8_t> gatherElements(const std::vector<std::uint8_t>& elements, std::size_t bytes,
                                         std::size_t stride, std::span<const std::uint32_t> source) {
  std::vector<std::uint8_t> gathered(stride * source.size(), 0);
  for (std::size_t i = 0; i < source.size(); ++i)
    std::memcpy(&gathered[i * stride], &elements[source[i] * bytes], bytes);
  return gathered;
}

std::vector<std::uint8_t> gatherSigned(const std::vector<float>& values, std::size_t components,
                                       std::span<const std::uint32_t> source,
                                       std::span<const std::uint8_t> negated) {
  std::vector<float> gathered;
  gathered.reserve(components * source.size());
  for (std::size_t i = 0; i < source.size(); ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const float value = values[source[i] * components + c];
      gathered.push_back(negated[i] != 0 ? -value : value);
    }
  std::vector<std::uint8_t> bytes(gathered.size() * sizeof(float));
  std::memcpy(bytes.data(), gathered.data(), bytes.size());
  return bytes;
}

}  // namespace

int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated) {
  constexpr int floatType = 5126;
  const AccessorReader reader(document, accessor);
  // The copy keeps the name, extras and extensions.
  Json copy = document.json["accessors"][accessor];
  for (const char* member : {"bufferView", "byteOffset", "sparse"}) copy.erase(member);
  copy["count"] = source.size();
  if (std::any_of(negated.begin(), negated.end(), [](std::uint8_t sign) { return sign != 0; })) {
    for (const char* member : {"normalized", "min", "max"}) copy.erase(member);
    copy["componentType"] = floatType;
    return appendVertexAccessor(document, std::move(copy),
                                gatherSigned(reader.floats(), reader.components(), source, negated),
                                reader.components() * sizeof(float));
  }
  const std::size_t bytes = elementBytes(reader.type(), static_cast<std::uint64_t>(reader.componentType()));
  const std::size_t stride = (bytes + 3) / 4 * 4;
  return appendVertexAccessor(document, std::move(copy),
                              gatherElements(reader.elements(), bytes, stride, source), stride);
}

}  // namespace prelight
