#pragma once

#include <cstdint>
#include <vector>

#include "plan/plan.h"
#include "shade/transport_scene.h"

namespace prelight {

/// Which of the passes "indirect light" and "caustic photons", in this order, a scene's light needs, and why.
std::vector<PlannedPass> lightPasses(const CompiledScene& compiled, const TransportScene& scene);

/// The pass that gives the backs of one-sided surfaces texels: of so many charts.
PlannedPass planBacks(std::uint32_t charts);

}  // namespace prelight
