#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "device/kernel.h"

namespace prelight {

/// Number of vertices that are adjacent in device arrays: PRELIGHT_TILE of kernels/relight/lane_funcs.cl.
constexpr std::size_t tileVertices = 16;

constexpr std::size_t tileCount(std::size_t vertices) { return (vertices + tileVertices - 1) / tileVertices; }

/// Rearranges [vertex][row], in one part or several, to [tile][row][lane]. Each part has whole vertices.
/// Lanes beyond the last vertex are 0.
template <typename T>
std::vector<T> tiled(std::span<const std::span<const T>> parts, std::size_t rows) {
  std::size_t count = 0;
  for (const std::span<const T>& part : parts) count += part.size();
  std::vector<T> tiles(rows == 0 ? 0 : tileCount(count / rows) * rows * tileVertices, T(0));
  std::size_t v = 0;
  for (const std::span<const T>& part : parts)
    for (std::size_t at = 0; at + rows <= part.size() && rows > 0; at += rows, ++v) {
      T* lane = tiles.data() + v / tileVertices * rows * tileVertices + v % tileVertices;
      for (std::size_t row = 0; row < rows; ++row) lane[row * tileVertices] = part[at + row];
    }
  return tiles;
}

template <typename T>
std::vector<T> tiled(std::span<const T> values, std::size_t rows) {
  return tiled(std::span<const std::span<const T>>(&values, 1), rows);
}

/// Build and launch of kernels over lanes: one tile per work-item on a CPU, one vertex elsewhere.
struct LaneLaunch {
  bool wide = false;
  std::size_t groupSize = 64;

  explicit LaneLaunch(const DeviceInfo& info)
      : wide(info.kind == DeviceKind::Cpu), groupSize(wide ? tileVertices : 64) {}

  BuildOptions options() const { return BuildOptions().defineIf(wide, "PRELIGHT_WIDE_LANES"); }
  WorkSize size(std::size_t vertices) const { return {wide ? tileCount(vertices) : vertices, groupSize}; }
};

}  // namespace prelight
