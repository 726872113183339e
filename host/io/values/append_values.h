#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include "io/values/baked_ranges.h"
#include "scene/gltf/gltf_document.h"

/// Functions that append values to a document as accessors and return the accessor's index.
namespace prelight {

template <typename T>
constexpr int componentTypeOf() {
  if constexpr (std::is_same_v<T, float>) return 5126;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  return 5121;
}

template <typename T>
int appendValues(GltfDocument& document, std::span<const T> values, const char* type = "SCALAR",
                 std::size_t components = 1) {
  return appendAccessor(document, std::as_bytes(values), type, componentTypeOf<T>(),
                        values.size() / components);
}

template <typename T>
int appendValues(GltfDocument& document, const std::vector<T>& values, const char* type = "SCALAR",
                 std::size_t components = 1) {
  return appendValues(document, std::span(values), type, components);
}

/// Appends `width` values per vertex for the vertices of a primitive.
template <typename T>
int appendVertices(GltfDocument& document, const std::vector<T>& values, const PrimitiveRanges& ranges,
                   std::size_t width) {
  return appendValues(document, gatherVertices(std::span<const T>(values), ranges, width));
}

/// Appends one vector per vertex for the vertices of a primitive.
inline int appendVectors(GltfDocument& document, const std::vector<glm::vec3>& vectors,
                         const PrimitiveRanges& ranges) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  const std::span<const float> floats(reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size());
  return appendValues(document, gatherVertices(floats, ranges, 3), "VEC3", 3);
}

}  // namespace prelight
