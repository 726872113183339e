#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "prelight/transfer.h"

namespace prelight {

/// Relighting of PCA, VQ and clustered PCA transfer on the device: products with means and components once a
/// light on the host, then a short sum a vertex.
class ClusterRelighter {
 public:
  /// The device must outlive the relighter. Throws UsageError for Half and Band8: see DenseRelighter.
  ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  std::size_t vertexCount() const { return vertices_; }
  /// Bytes that one relighting reads of vertices' weights and writes of radiance.
  std::size_t bytesMoved() const;

  /// Coefficients, [channel][i], 3 x order^2. Throws UsageError when their number is another.
  void setLight(std::span<const double> light);

  /// Radiance before albedo into `radiance`, [vertex][3]. Does not wait.
  void relight(Buffer<float>& radiance);

 private:
  DeviceContext& device_;
  CompressedTransfer shared_;  ///< shared by vertices: means, components, ranges
  std::size_t vertices_;
  Buffer<float> terms_;  ///< [cluster][1 + component][4]
  Buffer<std::uint16_t> clusters_;
  std::size_t weightBytes_ = 0;
  /// Weights as they are stored, and the kernel that reads them.
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
