#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/spans.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// The ranges of one primitive of one node, one per instance, in the instances' order.
using PrimitiveRanges = std::vector<PrimitiveRange>;

/// Groups the ranges by glTF node and primitive.
inline std::map<std::pair<int, int>, PrimitiveRanges> groupRanges(const CompiledScene& scene) {
  std::map<std::pair<int, int>, PrimitiveRanges> groups;
  for (const PrimitiveRange& range : scene.primitives) groups[{range.node, range.primitive}].push_back(range);
  for (auto& [key, ranges] : groups)
    std::sort(ranges.begin(), ranges.end(),
              [](const auto& a, const auto& b) { return a.instance < b.instance; });
  return groups;
}

inline std::size_t vertexCount(const PrimitiveRanges& ranges) {
  std::size_t count = 0;
  for (const PrimitiveRange& range : ranges) count += range.vertexCount;
  return count;
}

/// Returns `width` values per vertex of the ranges, one range after another.
template <typename T>
std::vector<T> gatherVertices(std::span<const T> values, const PrimitiveRanges& ranges, std::size_t width) {
  std::vector<T> gathered;
  gathered.reserve(vertexCount(ranges) * width);
  for (const PrimitiveRange& range : ranges) {
    const auto part = values.subspan(range.firstVertex * width, range.vertexCount * width);
    gathered.insert(gathered.end(), part.begin(), part.end());
  }
  return gathered;
}

/// Copies `values`, `width` per vertex of the ranges, to their places in `target`, `width` per vertex of the
/// scene.
template <typename T>
void scatterVertices(const std::vector<T>& values, const PrimitiveRanges& ranges, std::size_t width,
                     std::vector<T>& target) {
  auto from = values.begin();
  for (const PrimitiveRange& range : ranges) {
    const auto length = static_cast<std::ptrdiff_t>(range.vertexCount * width);
    std::copy(from, from + length, target.begin() + static_cast<std::ptrdiff_t>(range.firstVertex * width));
    from += length;
  }
}

/// glTF's component types that baked files have.
namespace component {
inline constexpr int int8 = 5120, uint8 = 5121, uint16 = 5123, uint32 = 5125, float32 = 5126;
}

// Functions that append values to a document as accessors and return the accessor's index.

template <typename T>
constexpr int componentTypeOf() {
  if constexpr (std::is_same_v<T, float>) return component::float32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return component::uint32;
  if constexpr (std::is_same_v<T, std::uint16_t>) return component::uint16;
  return component::uint8;
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
  return appendValues(document, gatherVertices(numbersOf(vectors), ranges, 3), "VEC3", 3);
}

}  // namespace prelight
