#include "relight/device/dense_relighter.h"
#include "relight/device/harmonic_part.h"
#include "techniques/sh/sh.h"

namespace prelight {

namespace {

/// Compressed transfer moves fewer bytes, and has the same values where a bake holds both.
std::string shForm(const Bake& bake) {
  if (bake.compressedSh) return compressedForm(*bake.compressedSh);
  return bake.sh ? denseForm(bake.sh->order, bake.sh->channels) : std::string();
}

std::unique_ptr<RelitPart> makeShPart(const RelitSource& source) {
  const Bake& bake = source.bake;
  std::unique_ptr<SeriesRelighter> series;
  if (bake.compressedSh)
    series = makeCompressedSeries(source.device, *bake.compressedSh);
  else
    series = std::make_unique<DenseRelighter>(source.device, *bake.sh);
  const int order = bake.compressedSh ? bake.compressedSh->order : bake.sh->order;
  const int channels = bake.compressedSh ? bake.compressedSh->channels : bake.sh->channels;
  auto open = openLightsAt(source, series->receiverCount(), order, channels);
  return std::make_unique<HarmonicPart>(std::move(series), order, source.device, std::move(open));
}

}  // namespace

const Relighting shRelighting = {
    .preference = preferVertices, .form = shForm, .make = makeShPart, .atVertices = true};

}  // namespace prelight
