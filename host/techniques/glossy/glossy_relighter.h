#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "prelight/bake.h"

namespace prelight {

/// Number of vertices that are adjacent in device arrays: PRELIGHT_TILE of host/techniques/glossy/lane_funcs.cl.
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

/// Glossy transfer on the device: matrix products once per light, and lobes once per view.
class GlossyRelighter {
 public:
  /// The device must outlive the relighter.
  GlossyRelighter(DeviceContext& device, const GlossyTransfer& transfer);

  std::size_t vertexCount() const { return vertices_; }
  /// Returns the bytes that light() reads and writes.
  std::size_t bytesMoved() const;

  /// Multiplies every matrix by the light, [channel][i], 3 x order^2. The coefficients of light arriving at
  /// each vertex stay on the device. Throws UsageError for another number of coefficients. Does not wait.
  void light(std::span<const double> light);

  /// Returns the arriving light, [vertex][3][i]; waits.
  std::vector<float> arriving() const;

  /// Computes radiance, [vertex][3], for a zonal lobe about each vertex's direction: the sum over bands of
  /// lobe[l] times the band of the arriving light in that direction. `directions` is [vertex], unit (the view
  /// direction reflected at the normal); `lobe` is [band] with `order` entries. Does not wait.
  void shade(Buffer<float>& directions, std::span<const double> lobe, Buffer<float>& radiance);

 private:
  DeviceContext& device_;
  LaneLaunch launch_;
  std::size_t order_, channels_, vertices_;
  Buffer<float> matrices_;
  Buffer<float> light_;
  Buffer<float> arriving_;
  Buffer<float> lobe_;
  Buffer<float> table_;
  using Floats = Buffer<float>;
  Kernel<Floats, Floats, std::uint32_t, Floats> lightKernel_;
  Kernel<Floats, Floats, Floats, Floats, std::uint32_t, Floats> shadeKernel_;
};

}  // namespace prelight
