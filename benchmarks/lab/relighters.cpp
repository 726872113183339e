#include "benchmarks/lab/relighters.h"

#include <fmt/format.h>

#include "benchmarks/lab/lab_kernels.h"
#include "prelight/error.h"
#include "relight/compressed_light.h"

namespace prelight {

namespace {

enum Storage : int { FloatStorage = 0, HalfStorage = 1, ByteStorage = 2 };

std::size_t squareOf(int order) { return static_cast<std::size_t>(order) * static_cast<std::size_t>(order); }

void checkLight(std::span<const double> light, std::size_t count) {
  if (light.size() != 3 * count)
    throw UsageError("light", fmt::format("got {} coefficients, expected 3 x {}", light.size(), count));
}

BuildOptions denseOptions(const LaneLaunch& launch, std::size_t count, std::size_t channels, int storage) {
  return launch.options()
      .define("PRELIGHT_COUNT", static_cast<int>(count))
      .define("PRELIGHT_CHANNELS", static_cast<int>(channels))
      .define("PRELIGHT_STORAGE", storage);
}

/// Returns the light as the kernel takes it: coefficients, then a constant per colour.
std::vector<float> lightArgument(std::span<const double> light) {
  std::vector<float> values(light.begin(), light.end());
  values.resize(light.size() + 3, 0.0f);
  return values;
}

}  // namespace

DenseRelighter::DenseRelighter(DeviceContext& device, std::size_t count, int channels, std::size_t numbers)
    : device_(device),
      launch_(device.info()),
      count_(count),
      channels_(static_cast<std::size_t>(channels)),
      vertices_(count == 0 ? 0 : numbers / (count * channels_)),
      light_(device, 3 * count + 3) {}

template <typename Number>
void DenseRelighter::store(std::span<const Number> transfer, int storage) {
  const std::vector<Number> tiles = tiled(transfer, channels_ * count_);
  stored_ = Stored<Number>{Buffer<Number>(device_, std::span<const Number>(tiles)),
                           {device_, labKernel(device_, "dense_kernels.cl"),
                            denseOptions(launch_, count_, channels_, storage), "relightDense"}};
  transferBytes_ = transfer.size_bytes();
}

DenseRelighter::DenseRelighter(DeviceContext& device, const HarmonicTransfer& transfer)
    : DenseRelighter(device, squareOf(transfer.order), transfer.channels, transfer.coefficients.size()) {
  store(std::span<const float>(transfer.coefficients), FloatStorage);
}

DenseRelighter::DenseRelighter(DeviceContext& device, const LightGroupTransfer& transfer)
    : DenseRelighter(device, transfer.groups.size(), transfer.channels, transfer.coefficients.size()) {
  store(std::span<const float>(transfer.coefficients), FloatStorage);
}

DenseRelighter::DenseRelighter(DeviceContext& device, const CompressedTransfer& transfer)
    : DenseRelighter(device, squareOf(transfer.order), transfer.channels,
                     transfer.vertexCount * transfer.dimension()) {
  if (transfer.method == CompressionMethod::Half) {
    store(std::span<const std::uint16_t>(transfer.halves), HalfStorage);
  } else if (transfer.method == CompressionMethod::Band8) {
    store(std::span<const std::uint8_t>(transfer.bytes), ByteStorage);
    ranges_ = transfer.ranges;
  } else {
    throw UsageError("relighting", "got clustered transfer, expected halves or bytes");
  }
}

std::size_t DenseRelighter::bytesMoved() const { return transferBytes_ + vertices_ * 3 * sizeof(float); }

void DenseRelighter::setLight(std::span<const double> light) {
  checkLight(light, count_);
  std::vector<float> values = lightArgument(light);
  if (!ranges_.empty()) {
    CompressedTransfer shape;  // the part of the transfer that lightOf() needs
    shape.method = CompressionMethod::Band8;
    shape.channels = static_cast<int>(channels_);
    shape.ranges = ranges_;
    shape.order = static_cast<int>(ranges_.size() / 2 / channels_);
    const CompressedLight ready = lightOf(shape, light);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < count_; ++i)
        values[c * count_ + i] = ready.terms[1 + i][static_cast<int>(c)];
      values[3 * count_ + c] = ready.terms[0][static_cast<int>(c)];
    }
  }
  light_.write(std::span<const float>(values));
}

void DenseRelighter::relight(Buffer<float>& radiance) {
  std::visit(
      [&](auto& stored) {
        stored.kernel.launch(launch_.size(vertices_), stored.tiles, light_,
                             static_cast<std::uint32_t>(vertices_), radiance);
      },
      stored_);
}

KeyframeRelighter::KeyframeRelighter(DeviceContext& device, std::span<const HarmonicTransfer> keys)
    : device_(device), launch_(device.info()) {
  if (keys.empty()) throw UsageError("keys", "got none, expected at least one");
  const HarmonicTransfer& first = keys.front();
  for (const HarmonicTransfer& key : keys)
    if (key.order != first.order || key.channels != first.channels ||
        key.coefficients.size() != first.coefficients.size())
      throw UsageError("keys", "got keys that differ in order, channels or vertices, expected all alike");
  count_ = squareOf(first.order);
  const std::size_t rows = static_cast<std::size_t>(first.channels) * count_;
  vertices_ = first.coefficients.size() / rows;
  for (const HarmonicTransfer& key : keys) {
    const auto tiles = tiled(std::span<const float>(key.coefficients), rows);
    keys_.emplace_back(device, std::span<const float>(tiles));
  }
  light_ = Buffer<float>(device, 3 * count_ + 3);
  kernel_ = {device, labKernel(device, "dense_kernels.cl"),
             denseOptions(launch_, count_, static_cast<std::size_t>(first.channels), FloatStorage),
             "relightBetweenKeys"};
}

void KeyframeRelighter::setLight(std::span<const double> light) {
  checkLight(light, count_);
  light_.write(std::span<const float>(lightArgument(light)));
}

void KeyframeRelighter::relight(std::size_t key, double blend, Buffer<float>& radiance) {
  if (key >= keys_.size() || !(blend >= 0.0 && blend <= 1.0) || (key + 1 == keys_.size() && blend > 0.0))
    throw UsageError("key",
                     fmt::format("got key {} with blend {}, expected one of {} and a next one to blend "
                                 "with in [0,1]",
                                 key, blend, keys_.size()));
  const Buffer<float>& next = keys_[key + 1 < keys_.size() ? key + 1 : key];
  kernel_.launch(launch_.size(vertices_), keys_[key], next, static_cast<float>(blend), light_,
                 static_cast<std::uint32_t>(vertices_), radiance);
}

namespace {

template <typename T>
Buffer<T> upload(DeviceContext& device, const std::vector<T>& values) {
  return Buffer<T>(device, std::span<const T>(values));
}

}  // namespace

ClusterRelighter::ClusterRelighter(DeviceContext& device, const CompressedTransfer& transfer)
    : device_(device), shared_(transfer), vertices_(transfer.vertexCount) {
  if (transfer.method == CompressionMethod::Half || transfer.method == CompressionMethod::Band8)
    throw UsageError("relighting", "got halves or bytes, expected clustered transfer");
  clusters_ = upload(device, transfer.clusterOf);
  shared_.weightFloats = {};
  shared_.weightHalves = {};
  shared_.weightBytes = {};
  shared_.clusterOf = {};
  terms_ = Buffer<float>(device, 4 * static_cast<std::size_t>(transfer.clusters * (1 + transfer.components)));
  const BuildOptions options = BuildOptions()
                                   .define("PRELIGHT_COMPONENTS", transfer.components)
                                   .define("PRELIGHT_STORAGE", static_cast<int>(transfer.weights))
                                   .defineIf(clusters_.size() > 0, "PRELIGHT_CLUSTERED");
  if (!transfer.weightHalves.empty())
    store(transfer.weightHalves, options);
  else if (!transfer.weightBytes.empty())
    store(transfer.weightBytes, options);
  else
    store(transfer.weightFloats, options);
}

template <typename Number>
void ClusterRelighter::store(const std::vector<Number>& weights, const BuildOptions& options) {
  stored_ = Stored<Number>{upload(device_, weights),
                           {device_, labKernel(device_, "cluster_kernels.cl"), options, "relightClusters"}};
  weightBytes_ = weights.size() * sizeof(Number);
}

std::size_t ClusterRelighter::bytesMoved() const {
  return (clusters_.size() > 0 ? clusters_.bytes() : 0) + weightBytes_ + vertices_ * 3 * sizeof(float);
}

void ClusterRelighter::setLight(std::span<const double> light) {
  const CompressedLight ready = lightOf(shared_, light);
  std::vector<float> terms;
  terms.reserve(4 * ready.terms.size());
  for (const glm::vec3& term : ready.terms) terms.insert(terms.end(), {term.x, term.y, term.z, 0.0f});
  terms_.write(std::span<const float>(terms));
}

void ClusterRelighter::relight(Buffer<float>& radiance) {
  std::visit(
      [&](auto& stored) {
        stored.kernel.launch(vertices_, terms_, clusters_, stored.weights,
                             static_cast<std::uint32_t>(vertices_), radiance);
      },
      stored_);
}

}  // namespace prelight
