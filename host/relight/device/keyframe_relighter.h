#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "device/lane_tiles.h"
#include "prelight/transfer.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/series_relighter.h"

namespace prelight {

/// Transfer at the keys of an animation: blends the dot products of the two keys around a moment. Since dot
/// products are linear, this equals blending the coefficients. The device must outlive the relighter.
class KeyframeRelighter final : public SeriesRelighter {
 public:
  /// `keys`, at least one, have the same order, channels and vertices; otherwise UsageError is thrown.
  KeyframeRelighter(DeviceContext& device, std::span<const HarmonicTransfer> keys);

  std::size_t receiverCount() const override { return vertices_; }
  std::size_t bytesMoved() const override;
  void setLight(std::span<const double> light) override;

  /// Sets the moment: (1 - blend) key + blend (key + 1). `blend` is in [0,1], and 0 for the last key;
  /// otherwise UsageError is thrown. Before the first call it is the first key.
  void setMoment(std::size_t key, double blend);

  void relight(Buffer<float>& radiance) override;

 private:
  LaneLaunch launch_;
  DenseShape shape_;
  std::size_t vertices_ = 0, key_ = 0;
  double blend_ = 0.0;
  std::vector<Buffer<float>> keys_;
  Buffer<float> light_;
  Kernel<Buffer<float>, Buffer<float>, std::uint32_t, Buffer<float>> oneKey_;
  Kernel<Buffer<float>, Buffer<float>, float, Buffer<float>, std::uint32_t, Buffer<float>> twoKeys_;
};

}  // namespace prelight
