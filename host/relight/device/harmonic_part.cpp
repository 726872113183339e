#include "relight/device/harmonic_part.h"

#include <fmt/format.h>

#include "prelight/error.h"
#include "relight/device/cluster_relighter.h"
#include "relight/device/dense_relighter.h"

namespace prelight {

void RelitPart::setTime(double) {
  throw UsageError("Relighter::setTime", "the transfer belongs to one moment",
                   "bake keys of an animation, and choose them");
}

HarmonicPart::HarmonicPart(std::unique_ptr<SeriesRelighter> series, int order, DeviceContext& device,
                           std::unique_ptr<OpenLights> open)
    : series_(std::move(series)), light_(device, order), open_(std::move(open)) {
  if (open_) through_ = Buffer<float>(device, 3 * series_->receiverCount());
}

std::size_t HarmonicPart::bytesMoved() const {
  return series_->bytesMoved() + (open_ ? open_->bytesMoved() : 0);
}

void HarmonicPart::light(const RelighterLight& light) {
  if (!open_) {
    series_->setLight(inBasis(light_.coefficientsOf(light)));
    return;
  }
  RelighterLight others = light;
  others.lights.clear();
  const std::vector<double> rest = inBasis(light_.coefficientsOf(others));
  open_->clear();
  for (DistantLight one : light.lights) {
    one.towards = light.rotation * one.towards;
    DistantLight unit = one;
    unit.irradiance = glm::dvec3(1.0);
    series_->setLight(inBasis(light_.coefficientsOf({.lights = {unit}})));
    series_->relight(through_);
    open_->add(one, through_.read());
  }
  open_->upload();
  series_->setLight(rest);
}

void HarmonicPart::relight(Buffer<float>& radiance) {
  series_->relight(radiance);
  if (open_) open_->addTo(radiance);
}

std::unique_ptr<SeriesRelighter> makeCompressedSeries(DeviceContext& device,
                                                      const CompressedTransfer& transfer) {
  if (transfer.clusters > 0) return std::make_unique<ClusterRelighter>(device, transfer);
  if (transfer.method == CompressionMethod::Rgbe)
    return std::make_unique<DenseRelighter>(device, decompress(transfer));
  return std::make_unique<DenseRelighter>(device, transfer);
}

namespace {

std::string shapeText(int order, int channels) {
  return fmt::format("order {}, {} channel{}", order, channels, channels == 1 ? "" : "s");
}

}  // namespace

std::string denseForm(int order, int channels) { return shapeText(order, channels) + ", rows of floats"; }

std::string compressedForm(const CompressedTransfer& transfer) {
  const std::string shape = shapeText(transfer.order, transfer.channels);
  switch (transfer.method) {
    case CompressionMethod::Half:
      return shape + ", rows of halves";
    case CompressionMethod::Band8:
      return shape + ", rows of bytes";
    case CompressionMethod::Rgbe:
      return shape + ", bytes with exponents, unpacked to rows of floats";
    case CompressionMethod::Pca:
    case CompressionMethod::Vq:
    case CompressionMethod::Cpca:
      break;
  }
  return fmt::format("{}, {} clusters of {} components, multiplied once per light", shape, transfer.clusters,
                     transfer.components);
}

}  // namespace prelight
