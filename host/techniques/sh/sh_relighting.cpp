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
  if (bake.compressedSh)
    return std::make_unique<HarmonicPart>(makeCompressedSeries(source.device, *bake.compressedSh),
                                          bake.compressedSh->order, source.device);
  return std::make_unique<HarmonicPart>(std::make_unique<DenseRelighter>(source.device, *bake.sh),
                                        bake.sh->order, source.device);
}

}  // namespace

const Relighting shRelighting = {
    .preference = preferVertices, .form = shForm, .make = makeShPart, .atVertices = true};

}  // namespace prelight
