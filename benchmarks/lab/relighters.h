#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "prelight/transfer.h"
#include "techniques/glossy/glossy_relighter.h"

namespace prelight {

/// Computes dot products of every vertex's transfer with a light on the device. Transfer is float, half or
/// 8-bit, or of light groups, whose colours are the light. The transfer is uploaded once, in tiles
/// (host/techniques/glossy/lane_funcs.cl). The device must outlive the relighter.
class DenseRelighter {
 public:
  DenseRelighter(DeviceContext& device, const HarmonicTransfer& transfer);
  DenseRelighter(DeviceContext& device, const LightGroupTransfer& transfer);
  /// Throws UsageError for methods other than Half and Band8: see ClusterRelighter.
  DenseRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  std::size_t vertexCount() const { return vertices_; }
  /// Returns the bytes of transfer and radiance that one relighting reads and writes.
  std::size_t bytesMoved() const;

  /// Sets coefficients, [channel][i], 3 x order^2, or the colours of light groups, [channel][group]. Throws
  /// UsageError for another number of values.
  void setLight(std::span<const double> light);

  /// Writes radiance before albedo to `radiance`, [vertex][3], at least 3 x vertexCount() long. Returns
  /// before the work is done.
  void relight(Buffer<float>& radiance);

 private:
  DenseRelighter(DeviceContext& device, std::size_t count, int channels, std::size_t numbers);

  DeviceContext& device_;
  LaneLaunch launch_;
  std::size_t count_, channels_, vertices_;
  std::size_t transferBytes_ = 0;
  /// Stored transfer and the kernel that reads it.
  template <typename Number>
  struct Stored {
    Buffer<Number> tiles;
    Kernel<Buffer<Number>, Buffer<float>, std::uint32_t, Buffer<float>> kernel;
  };
  template <typename Number>
  void store(std::span<const Number> transfer, int storage);

  std::variant<Stored<float>, Stored<std::uint16_t>, Stored<std::uint8_t>> stored_;
  std::vector<float> ranges_;  ///< [channel][band][offset, scale] of 8-bit transfer
  Buffer<float> light_;
};

/// Transfer at the keys of an animation: blends the dot products of the two keys around a moment. Since dot
/// products are linear, this equals blending the coefficients.
class KeyframeRelighter {
 public:
  /// `keys`, at least one, have the same order, channels and vertices; otherwise UsageError is thrown.
  KeyframeRelighter(DeviceContext& device, std::span<const HarmonicTransfer> keys);

  std::size_t vertexCount() const { return vertices_; }

  /// See DenseRelighter::setLight().
  void setLight(std::span<const double> light);

  /// Relights with (1 - blend) key + blend (key + 1). `blend` is in [0,1], and 0 for the last key. Returns
  /// before the work is done.
  void relight(std::size_t key, double blend, Buffer<float>& radiance);

 private:
  DeviceContext& device_;
  LaneLaunch launch_;
  std::size_t count_ = 0, vertices_ = 0;
  std::vector<Buffer<float>> keys_;
  Buffer<float> light_;
  Kernel<Buffer<float>, Buffer<float>, float, Buffer<float>, std::uint32_t, Buffer<float>> kernel_;
};

/// Relights PCA, VQ and clustered PCA transfer on the device. Products with means and components are computed
/// once per light on the host, followed by a short sum per vertex.
class ClusterRelighter {
 public:
  /// The device must outlive the relighter. Throws UsageError for Half and Band8: see DenseRelighter.
  ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  std::size_t vertexCount() const { return vertices_; }
  /// Returns the bytes of weights and radiance that one relighting reads and writes.
  std::size_t bytesMoved() const;

  /// Sets coefficients, [channel][i], 3 x order^2. Throws UsageError for another number of values.
  void setLight(std::span<const double> light);

  /// Writes radiance before albedo to `radiance`, [vertex][3]. Returns before the work is done.
  void relight(Buffer<float>& radiance);

 private:
  DeviceContext& device_;
  CompressedTransfer shared_;  ///< means, components and ranges that vertices share
  std::size_t vertices_;
  Buffer<float> terms_;  ///< [cluster][1 + component][4]
  Buffer<std::uint16_t> clusters_;
  std::size_t weightBytes_ = 0;
  /// Stored weights and the kernel that reads them.
  template <typename Number>
  struct Stored {
    Buffer<Number> weights;
    Kernel<Buffer<float>, Buffer<std::uint16_t>, Buffer<Number>, std::uint32_t, Buffer<float>> kernel;
  };
  template <typename Number>
  void store(const std::vector<Number>& weights, const BuildOptions& options);

  std::variant<Stored<float>, Stored<std::uint16_t>, Stored<std::uint8_t>> stored_;
};

}  // namespace prelight
