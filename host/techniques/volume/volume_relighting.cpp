#include "relight/device/dense_relighter.h"
#include "relight/device/harmonic_part.h"
#include "techniques/volume/volume.h"

namespace prelight {

namespace {

std::string volumeForm(const Bake& bake) {
  if (!bake.volume) return {};
  return bake.compressedParts.volume ? compressedForm(*bake.compressedParts.volume)
                                     : denseForm(bake.volume->order, bake.volume->channels);
}

/// Receivers are cells; the result is the mean radiance over all directions.
std::unique_ptr<RelitPart> makeVolumePart(const RelitSource& source) {
  const VolumeTransfer& volume = *source.bake.volume;
  const std::optional<CompressedTransfer>& compressed = source.bake.compressedParts.volume;
  std::unique_ptr<SeriesRelighter> series;
  if (compressed)
    series = makeCompressedSeries(source.device, *compressed);
  else
    series = std::make_unique<DenseRelighter>(
        source.device, DenseShape{volume.columns(), static_cast<std::size_t>(volume.channels)},
        volume.coefficients);
  return std::make_unique<HarmonicPart>(std::move(series), volume.order, source.device);
}

}  // namespace

const Relighting volumeRelighting = {.preference = preferAir, .form = volumeForm, .make = makeVolumePart};

}  // namespace prelight
