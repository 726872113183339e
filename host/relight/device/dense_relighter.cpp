#include "relight/device/dense_relighter.h"

#include <fmt/format.h>

#include "prelight/error.h"
#include "relight/device/compressed_light.h"

namespace prelight {

namespace {

DenseShape shapeOf(std::size_t count, int channels, DenseShape::Storage storage = DenseShape::Floats) {
  return {count, static_cast<std::size_t>(channels), storage};
}

std::size_t squareOf(int order) { return static_cast<std::size_t>(order) * static_cast<std::size_t>(order); }

DenseShape shapeOf(const CompressedTransfer& transfer) {
  const bool halves = transfer.method == CompressionMethod::Half;
  if (!halves && transfer.method != CompressionMethod::Band8)
    throw UsageError("relighting", "got clustered transfer, expected halves or bytes");
  return shapeOf(squareOf(transfer.order), transfer.channels,
                 halves ? DenseShape::Halves : DenseShape::Bytes);
}

}  // namespace

void checkSeriesLight(std::span<const double> light, std::size_t count) {
  if (light.size() != 3 * count)
    throw UsageError("light", fmt::format("got {} coefficients, expected 3 x {}", light.size(), count));
}

BuildOptions DenseShape::options(const LaneLaunch& launch) const {
  return launch.options()
      .define("PRELIGHT_COUNT", static_cast<int>(count))
      .define("PRELIGHT_CHANNELS", static_cast<int>(channels))
      .define("PRELIGHT_STORAGE", storage);
}

std::vector<float> denseLight(std::span<const double> light) {
  std::vector<float> values(light.begin(), light.end());
  values.resize(light.size() + 3, 0.0f);
  return values;
}

DenseRelighter::DenseRelighter(DeviceContext& device, const DenseShape& shape)
    : device_(device), launch_(device.info()), shape_(shape), light_(device, 3 * shape.count + 3) {}

template <typename Number>
void DenseRelighter::store(std::span<const std::span<const Number>> parts, ColorWrite write) {
  const std::vector<Number> tiles = tiled(parts, shape_.rows());
  const BuildOptions options = shape_.options(launch_).defineIf(write == ColorWrite::Add, "PRELIGHT_ADD");
  stored_ = Stored<Number>{Buffer<Number>(device_, std::span<const Number>(tiles)),
                           {device_, "relight/dense_kernels.cl", options, "relightDense"}};
  std::size_t numbers = 0;
  for (const std::span<const Number>& part : parts) numbers += part.size();
  receivers_ = shape_.rows() == 0 ? 0 : numbers / shape_.rows();
  transferBytes_ = numbers * sizeof(Number);
}

template <typename Number>
void DenseRelighter::store(std::span<const Number> transfer, ColorWrite write) {
  store(std::span<const std::span<const Number>>(&transfer, 1), write);
}

DenseRelighter::DenseRelighter(DeviceContext& device, const HarmonicTransfer& transfer)
    : DenseRelighter(device, shapeOf(squareOf(transfer.order), transfer.channels), transfer.coefficients) {}

DenseRelighter::DenseRelighter(DeviceContext& device, const CompressedTransfer& transfer)
    : DenseRelighter(device, shapeOf(transfer)) {
  if (transfer.method == CompressionMethod::Half) {
    store(std::span<const std::uint16_t>(transfer.halves));
  } else {
    store(std::span<const std::uint8_t>(transfer.bytes));
    ranges_ = transfer.ranges;
  }
}

DenseRelighter::DenseRelighter(DeviceContext& device, const DenseShape& shape, std::span<const float> rows,
                               ColorWrite write)
    : DenseRelighter(device, shape) {
  store(rows, write);
}

DenseRelighter::DenseRelighter(DeviceContext& device, const DenseShape& shape,
                               std::span<const std::span<const float>> parts)
    : DenseRelighter(device, shape) {
  store(parts);
}

std::size_t DenseRelighter::bytesMoved() const { return transferBytes_ + receivers_ * 3 * sizeof(float); }

void DenseRelighter::setLight(std::span<const double> light) {
  checkSeriesLight(light, shape_.count);
  std::vector<float> values = denseLight(light);
  if (!ranges_.empty()) {
    CompressedTransfer shape;  // the part of the transfer that lightOf() needs
    shape.method = CompressionMethod::Band8;
    shape.channels = static_cast<int>(shape_.channels);
    shape.ranges = ranges_;
    shape.order = static_cast<int>(ranges_.size() / 2 / shape_.channels);
    const CompressedLight ready = lightOf(shape, light);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < shape_.count; ++i)
        values[c * shape_.count + i] = ready.terms[1 + i][static_cast<int>(c)];
      values[3 * shape_.count + c] = ready.terms[0][static_cast<int>(c)];
    }
  }
  light_.write(std::span<const float>(values));
}

void DenseRelighter::relight(Buffer<float>& radiance) {
  std::visit(
      [&](auto& stored) {
        stored.kernel.launch(launch_.size(receivers_), stored.tiles, light_,
                             static_cast<std::uint32_t>(receivers_), radiance);
      },
      stored_);
}

}  // namespace prelight
