#include "techniques/chart_transfer/chart_transfer_planning.h"

#include <fmt/format.h>

namespace prelight {

namespace {

std::vector<PlannedPass> chartTransferPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.chartTransfer.size == 0) return {{Pass::ChartTransfer, false, "not asked for"}};
  if (request.sh.order == 0)
    return {{Pass::ChartTransfer, false, "they have the order of the SH transfer, which is not asked for"}};
  const std::size_t mapped =
      countMaterials(input.source, [](const Material& m) { return m.normalTexture.image >= 0; });
  return {{Pass::ChartTransfer, true,
           fmt::format("light maps of at most {0} x {0}, order {1}, {2}, with {3}",
                       request.chartTransfer.size, request.sh.order, plannedChannels(input.colored()),
                       mapped > 0 ? fmt::format("the normals{} of {} normal-mapped materials",
                                                request.chartTransfer.relief ? " and horizons" : "", mapped)
                                  : "shading normals, as no material has a normal map")}};
}

void addChartTransferToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.chartTransfer.size);
  if (request.chartTransfer.relief) hash.text("relief");
}

}  // namespace

Planning chartTransferPlanning() {
  return {.passes = chartTransferPasses, .addToKey = addChartTransferToKey};
}

}  // namespace prelight
