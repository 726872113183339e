#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "prelight/transfer.h"
#include "relight/device/series_relighter.h"

namespace prelight {

/// Relights PCA, VQ and clustered PCA transfer on the device. Products with means and components are computed
/// once per light on the host, followed by a short sum per receiver.
class ClusterRelighter final : public SeriesRelighter {
 public:
  /// The device must outlive the relighter. Throws UsageError for methods without components: see
  /// DenseRelighter.
  ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  std::size_t receiverCount() const override { return receivers_; }
  std::size_t bytesMoved() const override;
  void setLight(std::span<const double> light) override;
  void relight(Buffer<float>& radiance) override;

 private:
  DeviceContext& device_;
  CompressedTransfer shared_;  ///< means, components and ranges that receivers share
  std::size_t receivers_;
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
