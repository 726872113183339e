#include "techniques/volume/volume_projector.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/cast_orders.h"
#include "techniques/receiver_cast.h"
#include "techniques/volume/volume_caster.h"
#include "transfer/volume_light.h"

namespace prelight {

namespace {

class VolumeProjector final : public Projector {
 public:
  explicit VolumeProjector(const BakeContext& context) : context_(context) {
    requireShOrder(context.request, "VolumeRequest::size");
  }

  std::string_view stage() const override { return "volume"; }

  bool readsReflected() const override { return true; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const BakeRequest& request = context_.request;
    const SlotTransfer& transfer = cast->transfer(progress);
    const VolumeGrid grid = makeVolumeGrid(context_.scene, request.volume.size);
    const VolumeOptions options{request.sh.order,  cast->bounces(), request.lightGroups.wanted,
                                raysEach(request), request.seed,    request.limits};
    bake.volume =
        makeVolume(context_.scene, context_.mesh, context_.tracer, transfer, grid, options, progress);
    context_.report.rays += std::uint64_t{options.rays} * grid.count();
    context_.report.notes.push_back(
        fmt::format("volume: {} x {} x {} voxels of {:.3g} m, {} rays each, {} of them inside objects",
                    grid.size.x, grid.size.y, grid.size.z, grid.cell(), options.rays,
                    std::count(bake.volume->air.begin(), bake.volume->air.end(), 0)));
  }

 private:
  const BakeContext& context_;
};

}  // namespace

std::unique_ptr<Projector> volumeProjector(const BakeContext& context) {
  if (context.request.volume.size == 0) return nullptr;
  return std::make_unique<VolumeProjector>(context);
}

}  // namespace prelight
