#include "techniques/near_lamps/near_lamps_projector.h"

#include <optional>

#include "base/parallel.h"
#include "compress/half_float.h"
#include "plan/cast_orders.h"
#include "techniques/near_lamps/shell_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"
#include "transfer/near_lamps.h"

namespace prelight {

namespace {

constexpr std::size_t lampGrain = 1024;  // vertices that a thread takes at once

class NearLampsProjector final : public Projector {
 public:
  explicit NearLampsProjector(const BakeContext& context) : context_(context) {
    const ShellRange range = shellRange(context.scene);
    transfer_.order = nearLampOrder(context.request);
    transfer_.shells = context.request.nearLamps.shells;
    transfer_.nearest = range.nearest;
    transfer_.farthest = range.farthest;
  }

  std::string_view stage() const override { return "near lamps"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    ShellShape shape{transfer_.order, {}};
    for (int shell = 1; shell < transfer_.shells; ++shell)
      shape.starts.push_back(static_cast<float>(shellStart(transfer_, shell)));
    columns.push_back(&shells_.emplace(std::move(shape)));
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const std::vector<float> fitted = shells_->solve(cast->front(), progress);
    const std::size_t width = transfer_.columns() * static_cast<std::size_t>(transfer_.shells);
    transfer_.halves.resize(context_.scene.vertexCount() * width);
    parallelRanges(context_.scene.vertexCount(), lampGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        for (std::size_t i = 0; i < width; ++i)
          transfer_.halves[v * width + i] =
              toHalf(finiteOr(fitted[context_.mesh.slotOfVertex[v] * width + i], 0.0f));
    });
    bake.nearLamps = transfer_;
  }

 private:
  const BakeContext& context_;
  NearLampTransfer transfer_;
  std::optional<ShellColumn> shells_;
};

}  // namespace

std::unique_ptr<Projector> nearLampsProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::NearLamps)) return nullptr;
  return std::make_unique<NearLampsProjector>(context);
}

}  // namespace prelight
