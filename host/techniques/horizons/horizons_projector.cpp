#include "techniques/horizons/horizons_projector.h"

#include "base/parallel.h"
#include "techniques/horizons/sector_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"
#include "transfer/horizons.h"

namespace prelight {

namespace {

constexpr std::size_t horizonGrain = 4096;  // vertices that a thread takes at once

class HorizonsProjector final : public Projector {
 public:
  explicit HorizonsProjector(const BakeContext& context)
      : context_(context),
        sectors_(static_cast<std::size_t>(context.request.horizons.sectors)),
        column_(static_cast<std::uint32_t>(sectors_)) {}

  std::string_view stage() const override { return "horizons"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&column_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const std::vector<float> fitted = column_.solve(cast->front(), progress);
    HorizonTransfer horizons{static_cast<int>(sectors_), {}, {}};
    horizons.angles.resize(context_.scene.vertexCount() * sectors_);
    horizons.feet.resize(horizons.angles.size());
    parallelRanges(context_.scene.vertexCount(), horizonGrain, [&](std::size_t begin, std::size_t end) {
      std::vector<SectorRays> rays(sectors_);
      for (std::size_t v = begin; v < end; ++v) {
        const float* values = &fitted[context_.mesh.slotOfVertex[v] * sectorRows * sectors_];
        for (std::size_t s = 0; s < sectors_; ++s) rays[s] = raysOf(values + s);
        closedBands(rays, std::span(horizons.feet).subspan(v * sectors_, sectors_),
                    std::span(horizons.angles).subspan(v * sectors_, sectors_));
      }
    });
    bake.horizons = std::move(horizons);
  }

 private:
  const BakeContext& context_;
  /// Values of a sector, of a vertex.
  SectorRays raysOf(const float* values) const {
    return {.open = 1.0 + double(finiteOr(values[sectors_], -1.0f)),
            .closed = double(finiteOr(values[0], 1.0f)),
            .height = double(finiteOr(values[2 * sectors_], 0.5f))};
  }

  std::size_t sectors_;
  SectorColumn column_;
};

}  // namespace

std::unique_ptr<Projector> horizonsProjector(const BakeContext& context) {
  if (context.request.horizons.sectors == 0) return nullptr;
  return std::make_unique<HorizonsProjector>(context);
}

}  // namespace prelight
