#pragma once

#include <vector>

#include "plan/plan.h"
#include "shade/transport_scene.h"

namespace prelight {

/// Which of the passes "indirect light" and "caustic photons", in this order, a scene's light needs, and why.
std::vector<PlannedPass> lightPasses(const CompiledScene& compiled, const TransportScene& scene);

}  // namespace prelight
