#pragma once

#include "charts/texel_sizes.h"
#include "prelight/device.h"
#include "techniques/light_map/light_map_sources.h"

namespace prelight {

/// The charts of a scene's light map, laid out with texels of one size or of sizes by the error that is asked
/// for (chooseTexelSizes): then pilots of a quarter of the request's rays tell it, which `rays` counts, and
/// `report` says what came of it. Throws UsageError as layOutLightMap() and Interrupted.
LightMapLayout makeLightMapLayout(const Scene& source, const CompiledScene& scene, const BakeRequest& request,
                                  const Plan& plan, const Device& device, Tracer& tracer, Progress& progress,
                                  LightMapReport& report, std::uint64_t& rays);

}  // namespace prelight
