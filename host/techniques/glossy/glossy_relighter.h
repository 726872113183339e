#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "device/lane_tiles.h"
#include "prelight/bake.h"

namespace prelight {

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
