#include "relight/device/dense_relighter.h"
#include "relight/device/harmonic_part.h"
#include "techniques/chart_transfer/chart_transfer.h"

namespace prelight {

namespace {

std::string texelsForm(const Bake& bake) {
  if (!bake.chartTransfer) return {};
  return bake.compressedParts.texels ? compressedForm(*bake.compressedParts.texels)
                                     : denseForm(bake.chartTransfer->order, bake.chartTransfer->channels);
}

/// Receivers are the texels of all maps, map by map.
std::unique_ptr<RelitPart> makeTexelPart(const RelitSource& source) {
  const ChartTransfer& charts = *source.bake.chartTransfer;
  const std::optional<CompressedTransfer>& compressed = source.bake.compressedParts.texels;
  std::unique_ptr<SeriesRelighter> series;
  if (compressed) {
    series = makeCompressedSeries(source.device, *compressed);
  } else {
    std::vector<std::span<const float>> maps;
    for (const ChartTransfer::Map& map : charts.maps) maps.emplace_back(map.coefficients);
    series =
        std::make_unique<DenseRelighter>(source.device,
                                         DenseShape{static_cast<std::size_t>(charts.order * charts.order),
                                                    static_cast<std::size_t>(charts.channels)},
                                         std::span<const std::span<const float>>(maps));
  }
  return std::make_unique<HarmonicPart>(std::move(series), charts.order, source.device);
}

}  // namespace

const Relighting texelRelighting = {.preference = preferSurfaces, .form = texelsForm, .make = makeTexelPart};

}  // namespace prelight
