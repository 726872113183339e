#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "device/kernel.h"
#include "device/lane_tiles.h"
#include "prelight/transfer.h"
#include "relight/device/series_relighter.h"

namespace prelight {

/// How a relighter writes colours into a buffer.
enum class ColorWrite : std::uint8_t {
  Replace,
  Add,
};

/// Kernel constants of dense transfer: coefficients per channel, channels, and how numbers are stored.
struct DenseShape {
  enum Storage : int { Floats = 0, Halves = 1, Bytes = 2 };

  std::size_t count = 0;     ///< coefficients per channel
  std::size_t channels = 1;  ///< 1 or 3
  Storage storage = Floats;

  BuildOptions options(const LaneLaunch& launch) const;
  std::size_t rows() const { return channels * count; }
};

/// Returns the light as dense kernels take it: coefficients, then a constant 0 per colour.
std::vector<float> denseLight(std::span<const double> light);

/// Computes dot products of every receiver's transfer with a light on the device. Transfer is float, half or
/// 8-bit. It is uploaded once, in tiles (kernels/relight/lane_funcs.cl). The device must outlive the
/// relighter.
class DenseRelighter final : public SeriesRelighter {
 public:
  DenseRelighter(DeviceContext& device, const HarmonicTransfer& transfer);

  /// Takes the methods Half and Band8; throws UsageError for others: see ClusterRelighter.
  DenseRelighter(DeviceContext& device, const CompressedTransfer& transfer);

  /// Takes rows of floats, [receiver][channel][coefficient], in one part or several; each part has whole
  /// rows.
  DenseRelighter(DeviceContext& device, const DenseShape& shape, std::span<const float> rows,
                 ColorWrite write = ColorWrite::Replace);
  DenseRelighter(DeviceContext& device, const DenseShape& shape,
                 std::span<const std::span<const float>> parts);

  std::size_t receiverCount() const override { return receivers_; }
  std::size_t bytesMoved() const override;
  void setLight(std::span<const double> light) override;
  void relight(Buffer<float>& radiance) override;

 private:
  DenseRelighter(DeviceContext& device, const DenseShape& shape);

  template <typename Number>
  void store(std::span<const std::span<const Number>> parts, ColorWrite write = ColorWrite::Replace);
  template <typename Number>
  void store(std::span<const Number> transfer, ColorWrite write = ColorWrite::Replace);

  DeviceContext& device_;
  LaneLaunch launch_;
  DenseShape shape_;
  std::size_t receivers_ = 0, transferBytes_ = 0;
  /// Stored transfer and the kernel that reads it.
  template <typename Number>
  struct Stored {
    Buffer<Number> tiles;
    Kernel<Buffer<Number>, Buffer<float>, std::uint32_t, Buffer<float>> kernel;
  };
  std::variant<Stored<float>, Stored<std::uint16_t>, Stored<std::uint8_t>> stored_;
  std::vector<float> ranges_;  ///< [channel][band][offset, scale] of 8-bit transfer
  Buffer<float> light_;
};

}  // namespace prelight
