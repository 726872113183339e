#include "projectors/horizons/horizons_projector.h"

#include "base/parallel.h"
#include "projectors/packed_values.h"
#include "projectors/receiver_cast.h"
#include "transfer/horizons.h"

namespace prelight {

namespace {

constexpr std::size_t horizonGrain = 4096;  // vertices that a thread takes at once

class HorizonsProjector final : public Projector {
 public:
  explicit HorizonsProjector(const BakeContext& context)
      : context_(context), sectors_(static_cast<std::size_t>(context.request.horizons.sectors)) {}

  std::string_view stage() const override { return "horizons"; }

  void addNeeds(CastNeeds& needs) const override { needs.sectors = static_cast<std::uint32_t>(sectors_); }

  void run(ReceiverCast* cast, Bake& bake, Progress& /*progress*/) override {
    const std::vector<float> fitted = cast->front().solveSectors();
    HorizonTransfer horizons{static_cast<int>(sectors_), {}};
    horizons.angles.resize(context_.scene.vertexCount() * sectors_);
    parallelRanges(context_.scene.vertexCount(), horizonGrain, [&](std::size_t begin, std::size_t end) {
      std::vector<double> open(sectors_);
      for (std::size_t v = begin; v < end; ++v) {
        const float* closed = &fitted[context_.mesh.slotOfVertex[v] * sectors_];
        for (std::size_t s = 0; s < sectors_; ++s) open[s] = 1.0 + double(finiteOr(closed[s], -1.0f));
        horizonsOfOpenness(open, std::span(horizons.angles).subspan(v * sectors_, sectors_));
      }
    });
    bake.horizons = std::move(horizons);
  }

 private:
  const BakeContext& context_;
  std::size_t sectors_;
};

}  // namespace

std::unique_ptr<Projector> horizonsProjector(const BakeContext& context) {
  if (context.request.horizons.sectors == 0) return nullptr;
  return std::make_unique<HorizonsProjector>(context);
}

}  // namespace prelight
