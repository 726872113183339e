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
