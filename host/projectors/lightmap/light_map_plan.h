#pragma once

#include <cstdint>
#include <vector>

#include "lightmap/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// What charts are made by, and texels where all have one size.
LightMapLayoutRequest lightMapRequest(const BakeRequest& request);

/// The smallest that texels of sizes by error may be, m.
double finestTexel(const BakeRequest& request, const LightMapCharts& charts);

/// Passes "light map", "texel sizes", and "direct", "sky" and "indirect light", "caustics" and "directions of
/// the map": whether they run, and why.
std::vector<PlannedPass> planLightMap(const Scene& source, const CompiledScene& scene,
                                      const BakeRequest& request);

/// Of LightMap: 5 where the plan keeps directions.
int lightMapCoefficients(const Plan& plan);

/// That a light map takes while it is baked, about.
std::uint64_t lightMapBytes(const CompiledScene& scene, const BakeRequest& request, int coefficients);

}  // namespace prelight
