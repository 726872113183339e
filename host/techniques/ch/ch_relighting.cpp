#include "basis/ch.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/harmonic_part.h"
#include "techniques/ch/ch.h"

namespace prelight {

namespace {

/// Transfer in CH, which takes the moments of light.
class ChPart final : public HarmonicPart {
 public:
  ChPart(std::unique_ptr<SeriesRelighter> series, int order, DeviceContext& device,
         std::unique_ptr<OpenLights> open)
      : HarmonicPart(std::move(series), order, device, std::move(open)), basis_(order) {}

 private:
  std::vector<double> inBasis(std::vector<double> sh) const override {
    const std::size_t n = sh.size() / 3;
    std::vector<double> moments(sh.size());
    for (std::size_t c = 0; c < 3; ++c)
      basis_.momentsFromSh(std::span<const double>(sh).subspan(c * n, n),
                           std::span(moments).subspan(c * n, n));
    return moments;
  }

  ch::Basis basis_;
};

std::string chForm(const Bake& bake) {
  return bake.ch ? denseForm(bake.ch->order, bake.ch->channels) : std::string();
}

std::unique_ptr<RelitPart> makeChPart(const RelitSource& source) {
  const HarmonicTransfer& transfer = *source.bake.ch;
  auto series = std::make_unique<DenseRelighter>(source.device, transfer);
  auto open = openLightsAt(source, series->receiverCount(), transfer.order, transfer.channels);
  return std::make_unique<ChPart>(std::move(series), transfer.order, source.device, std::move(open));
}

}  // namespace

const Relighting chRelighting = {
    .preference = preferVertices, .form = chForm, .make = makeChPart, .atVertices = true};

}  // namespace prelight
