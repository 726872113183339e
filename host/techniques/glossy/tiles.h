#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "device/kernel.h"

namespace prelight {

/// Number of vertices that are adjacent in device arrays: PRELIGHT_TILE of
/// host/techniques/glossy/lane_funcs.cl.
constexpr std::size_t tileVertices = 16;

constexpr std::size_t tileCount(std::size_t vertices) { return (vertices + tileVertices - 1) / tileVertices; }

/// Rearranges [vertex][row] to [tile][row][lane]. Lanes beyond the last vertex are 0.
template <typename T>
std::vector<T> tiled(std::span<const T> values, std::size_t rows) {
  const std::size_t vertices = rows == 0 ? 0 : values.size() / rows;
  std::vector<T> tiles(tileCount(vertices) * rows * tileVertices, T(0));
  for (std::size_t v = 0; v < vertices; ++v) {
    T* lane = tiles.data() + v / tileVertices * rows * tileVertices + v % tileVertices;
    for (std::size_t row = 0; row < rows; ++row) lane[row * tileVertices] = values[v * rows + row];
  }
  return tiles;
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
