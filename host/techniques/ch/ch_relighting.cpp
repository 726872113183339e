#include "basis/ch.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/harmonic_part.h"
#include "techniques/ch/ch.h"

namespace prelight {

namespace {

/// Transfer in CH, which takes the moments of light.
class ChPart final : public HarmonicPart {
 public:
  ChPart(const HarmonicTransfer& transfer, DeviceContext& device)
      : HarmonicPart(std::make_unique<DenseRelighter>(device, transfer), transfer.order, device),
        basis_(transfer.order) {}

  void light(const RelighterLight& light) override {
    const std::vector<double> sh = light_.coefficientsOf(light);
    const std::size_t n = sh.size() / 3;
    std::vector<double> moments(sh.size());
    for (std::size_t c = 0; c < 3; ++c)
      basis_.momentsFromSh(std::span(sh).subspan(c * n, n), std::span(moments).subspan(c * n, n));
    series_->setLight(moments);
  }

 private:
  ch::Basis basis_;
};

std::string chForm(const Bake& bake) {
  return bake.ch ? denseForm(bake.ch->order, bake.ch->channels) : std::string();
}

std::unique_ptr<RelitPart> makeChPart(const RelitSource& source) {
  return std::make_unique<ChPart>(*source.bake.ch, source.device);
}

}  // namespace

const Relighting chRelighting = {
    .preference = preferVertices, .form = chForm, .make = makeChPart, .atVertices = true};

}  // namespace prelight
