#pragma once

#include <cstdint>
#include <vector>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// Working memory of the denoiser of a light map, whose charts are small.
constexpr int denoiserMegabytes = 256;

/// What charts are made by, and texels where all have one size.
LightMapLayoutRequest lightMapRequest(const BakeRequest& request);

/// The request with the rays a texel and the photons of its light map as `effort.rays` and
/// `lightMap.photons`: as they are asked for, but where a map has more texels than the fewest usual ones and
/// nobody asked for their size, each gets fewer. The rays of all then grow with the cube root of their
/// number.
BakeRequest withTexelEffort(const CompiledScene& scene, BakeRequest request);

/// The smallest that texels of sizes by error may be, m.
double finestTexel(const BakeRequest& request, const LightMapCharts& charts);

/// Passes "light map", "texel sizes", and "direct", "sky" and "indirect light", "caustics" and "directions of
/// the map": whether they run, and why.
std::vector<PlannedPass> planLightMap(const CompiledScene& scene, const BakeRequest& request);

/// Some surface reflects diffusely.
bool takesLight(const CompiledScene& scene);

/// Texels that a map has at most, about.
std::uint64_t mostTexels(const CompiledScene& scene, const BakeRequest& request);

/// LightMap::coefficients while it is baked: as many as it keeps, or as light that is to be encoded needs.
int lightMapCoefficients(const Plan& plan);

/// LightMap::coefficients that are kept: those of order 2 where the plan keeps directions, else 1.
int keptLightMapCoefficients(const Plan& plan);

/// Bytes that a light map takes while it is baked, about.
std::uint64_t lightMapBytes(const CompiledScene& scene, const BakeRequest& request, int coefficients);

}  // namespace prelight
