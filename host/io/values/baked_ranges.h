#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "prelight/compiled_scene.h"

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

}  // namespace prelight
