#include "techniques/chart_transfer/chart_transfer_projector.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/cast_orders.h"
#include "prelight/error.h"
#include "techniques/chart_transfer/chart_caster.h"
#include "techniques/receiver_cast.h"
#include "receivers/chart_sampler.h"

namespace prelight {

namespace {

void checkMemory(const BakeRequest& request, const Charts& charts) {
  std::uint64_t bytes = 0;
  for (const Chart& chart : charts.charts)
    bytes += static_cast<std::uint64_t>(chart.width) * static_cast<std::uint64_t>(chart.height) * 4u *
             static_cast<std::uint64_t>(request.sh.order * request.sh.order *
                                        (request.bounces > 0 || request.specular ? 3 : 1));
  if (bytes > request.memory())
    throw UsageError("ChartTransferRequest::size",
                     fmt::format("{} light maps take {} MB, more than the {} MB of BakeRequest::maxMemory",
                                 charts.charts.size(), bytes >> 20, request.memory() >> 20),
                     "bake fewer texels or a lower order, or raise BakeRequest::maxMemory");
}

class ChartTransferProjector final : public Projector {
 public:
  explicit ChartTransferProjector(const BakeContext& context) : context_(context) {
    requireShOrder(context.request, "ChartTransferRequest::size");
    checkMemory(context.request, *context.charts);
  }

  std::string_view stage() const override { return "texels"; }

  bool readsReflected() const override { return true; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const BakeRequest& request = context_.request;
    ChartTransferOptions options{request.sh.order, cast->bounces(), raysEach(request), request.seed,
                                 request.limits};
    options.specular = specularWaysOf(context_, request.sh.order);
    options.sets = &context_.sets;
    options.setTracers = context_.setTracers;
    options.relief = request.chartTransfer.relief;
    const SlotTransfer& transfer = cast->transfer(progress);
    ChartTransferReport made;
    bake.chartTransfer = makeChartTransfer(context_.scene, *context_.charts, context_.mesh, context_.tracer,
                                           transfer, options, progress, made);
    context_.report.rays += made.rays;
    context_.report.notes.push_back(
        fmt::format("texels: {} light maps, {} texels of them on the surface, {} rays each, {:.3g} % of "
                    "those from inside objects",
                    bake.chartTransfer->maps.size(), made.texels, options.rays,
                    100.0 * double(made.hidden * (options.rays / ChartSampler::positionsPerTexel)) /
                        double(std::max<std::uint64_t>(made.rays, 1))));
  }

 private:
  const BakeContext& context_;
};

}  // namespace

std::unique_ptr<Projector> chartTransferProjector(const BakeContext& context) {
  if (context.charts == nullptr || context.charts->charts.empty()) return nullptr;
  return std::make_unique<ChartTransferProjector>(context);
}

}  // namespace prelight
