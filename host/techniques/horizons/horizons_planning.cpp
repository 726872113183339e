#include "techniques/horizons/horizons_planning.h"

#include <fmt/format.h>

#include "techniques/horizons/sector_column.h"

namespace prelight {

namespace {

std::vector<PlannedPass> horizonsPasses(const PlanInput& input) {
  const int sectors = input.request.horizons.sectors;
  if (sectors == 0) return {};
  return {{Pass::Horizons, true, fmt::format("of {} sectors of azimuth, from the same cast", sectors)}};
}

/// Sums of the fit, its solution, and what is stored of it.
void addHorizonsMemory(const PlanInput& input, Plan& plan) {
  const auto sectors = static_cast<std::uint64_t>(input.request.horizons.sectors);
  if (sectors == 0) return;
  plan.hostBytes += input.scene.vertexCount() * sectors * (sectorRows * (4 + 4) + 4 + 4) +
                    24ull * input.scene.triangleCount();
}

void addHorizonsToKey(const BakeRequest& request, StateHash& hash) {
  if (request.horizons.sectors == 0) return;
  hash.text("horizons");
  hash.value(request.horizons.sectors);
}

}  // namespace

Planning horizonsPlanning() {
  return {.passes = horizonsPasses, .addMemory = addHorizonsMemory, .addToKey = addHorizonsToKey};
}

}  // namespace prelight
