#include "relight/device/keyframe_relighter.h"

#include <fmt/format.h>

#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns the shape that all keys have.
DenseShape sharedShape(std::span<const HarmonicTransfer> keys) {
  if (keys.empty()) throw UsageError("keys", "got none, expected at least one");
  const HarmonicTransfer& first = keys.front();
  for (const HarmonicTransfer& key : keys)
    if (key.order != first.order || key.channels != first.channels ||
        key.coefficients.size() != first.coefficients.size())
      throw UsageError("keys", "got keys that differ in order, channels or vertices, expected all alike");
  return {static_cast<std::size_t>(first.order * first.order), static_cast<std::size_t>(first.channels)};
}

}  // namespace

KeyframeRelighter::KeyframeRelighter(DeviceContext& device, std::span<const HarmonicTransfer> keys)
    : launch_(device.info()), shape_(sharedShape(keys)), light_(device, 3 * shape_.count + 3) {
  vertices_ = keys.front().coefficients.size() / shape_.rows();
  for (const HarmonicTransfer& key : keys) {
    const auto tiles = tiled(std::span<const float>(key.coefficients), shape_.rows());
    keys_.emplace_back(device, std::span<const float>(tiles));
  }
  const BuildOptions options = shape_.options(launch_);
  oneKey_ = {device, "relight/dense_kernels.cl", options, "relightDense"};
  twoKeys_ = {device, "relight/dense_kernels.cl", options, "relightBetweenKeys"};
}

std::size_t KeyframeRelighter::bytesMoved() const {
  const std::size_t read = blend_ > 0.0 ? 2 : 1;
  return vertices_ * (read * shape_.rows() + 3) * sizeof(float);
}

void KeyframeRelighter::setLight(std::span<const double> light) {
  checkSeriesLight(light, shape_.count);
  light_.write(std::span<const float>(denseLight(light)));
}

void KeyframeRelighter::setMoment(std::size_t key, double blend) {
  if (key >= keys_.size() || !(blend >= 0.0 && blend <= 1.0) || (key + 1 == keys_.size() && blend > 0.0))
    throw UsageError("key",
                     fmt::format("got key {} with blend {}, expected one of {} and a next one to blend "
                                 "with in [0,1]",
                                 key, blend, keys_.size()));
  key_ = key;
  blend_ = blend;
}

void KeyframeRelighter::relight(Buffer<float>& radiance) {
  const auto count = static_cast<std::uint32_t>(vertices_);
  if (blend_ > 0.0)
    twoKeys_.launch(launch_.size(vertices_), keys_[key_], keys_[key_ + 1], static_cast<float>(blend_), light_,
                    count, radiance);
  else
    oneKey_.launch(launch_.size(vertices_), keys_[key_], light_, count, radiance);
}

}  // namespace prelight
