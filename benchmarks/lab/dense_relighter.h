#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "prelight/transfer.h"
#include "techniques/glossy/glossy_relighter.h"

namespace prelight {

/// Dot products of every vertex's transfer with a light, on the device: float, half or 8-bit transfer, and
/// light groups, whose colours are the light. The transfer is uploaded once, in tiles
/// (host/techniques/glossy/lane_funcs.cl). The device must outlive the relighter.
class DenseRelighter {
 public:
  DenseRelighter(DeviceContext& device, const HarmonicTransfer& transfer);
  DenseRelighter(DeviceContext& device, const LightGroupTransfer& transfer);
  /// Throws UsageError for methods other than Half and Band8: see ClusterRelighter.
  DenseRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  std::size_t vertexCount() const { return vertices_; }
  /// Bytes that one relighting reads of the transfer and writes of radiance.
  std::size_t bytesMoved() const;

  /// Coefficients, [channel][i], 3 x order^2; or [channel][group], the colours of light groups. Throws
  /// UsageError when their number is another.
  void setLight(std::span<const double> light);

  /// Radiance before albedo into `radiance`, [vertex][3], at least 3 x vertexCount() long. Does not wait.
  void relight(Buffer<float>& radiance);

 private:
  DenseRelighter(DeviceContext& device, std::size_t count, int channels, std::size_t numbers);

  DeviceContext& device_;
  LaneLaunch launch_;
  std::size_t count_, channels_, vertices_;
  std::size_t transferBytes_ = 0;
  /// Transfer as it is stored, and the kernel that reads it.
  template <typename Number>
  struct Stored {
    Buffer<Number> tiles;
    Kernel<Buffer<Number>, Buffer<float>, std::uint32_t, Buffer<float>> kernel;
  };
  template <typename Number>
  void store(std::span<const Number> transfer, int storage);

  std::variant<Stored<float>, Stored<std::uint16_t>, Stored<std::uint8_t>> stored_;
  std::vector<float> ranges_;  ///< ranges of 8-bit transfer: [channel][band][offset, scale]
  Buffer<float> light_;
};

/// Transfer at the keys of an animation: dot products of the two keys around a moment, blended. Since they
/// are linear, blending them is blending the coefficients.
class KeyframeRelighter {
 public:
  /// Keys of one order, number of channels and of vertices, at least one. Throws UsageError for others.
  KeyframeRelighter(DeviceContext& device, std::span<const HarmonicTransfer> keys);

  std::size_t vertexCount() const { return vertices_; }

  /// As DenseRelighter.
  void setLight(std::span<const double> light);

  /// (1 - blend) key + blend (key + 1). `blend` in [0,1]; the last key needs blend 0. Does not wait.
  void relight(std::size_t key, double blend, Buffer<float>& radiance);

 private:
  DeviceContext& device_;
  LaneLaunch launch_;
  std::size_t count_ = 0, vertices_ = 0;
  std::vector<Buffer<float>> keys_;
  Buffer<float> light_;
  Kernel<Buffer<float>, Buffer<float>, float, Buffer<float>, std::uint32_t, Buffer<float>> kernel_;
};

}  // namespace prelight
