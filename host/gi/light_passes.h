#pragma once

#include <cstdint>
#include <vector>

#include "gpu/transport_scene.h"
#include "plan/plan.h"
#include "scene/compiled_scene.h"

namespace prelight {

/// Which of the passes "indirect light" and "caustic photons", in this order, a scene's light needs, and why.
std::vector<PlannedPass> lightPasses(const CompiledScene& compiled, const TransportScene& scene);

/// The pass that gives the backs of one-sided surfaces texels: of so many charts.
PlannedPass planBacks(std::uint32_t charts);

}  // namespace prelight
