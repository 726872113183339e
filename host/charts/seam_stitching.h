#pragma once

#include <cstdint>
#include <vector>

#include "charts/light_map_lookup.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// A point of an edge that lies at two places of a light map.
struct SeamPoint {
  LightMapLookUp first, second;
  double length = 0.0;  ///< length of the edge that it represents, m
};

/// Returns points, at least two per texel, along every edge where the surface continues at less than the
/// crease angle (scene/surface/surface_regions.h) and the map does not; without those where a wall stands on
/// the edge. The tracer must be that of the scene.
std::vector<SeamPoint> seamsOf(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                               double creaseAngle);

/// Returns the texel with the greatest weight in a look-up.
std::uint32_t nearestTexel(const LightMapLookUp& at);

/// Returns the root mean square, over the length of the seams and the channels, of the difference between the
/// irradiances on both sides, W/m2.
double seamJump(const LightMap& map, const std::vector<SeamPoint>& seams);

/// Changes the values of texels beside seams as little as needed to make both sides agree: least squares of
/// the jumps and, with a twentieth of the weight, of the changes (Iwanicki 2013, "Lighting technology of The
/// Last of Us", has the same aim). Irradiance does not fall below 0. Texels away from seams keep their
/// values. Throws Interrupted between coefficients; finished ones are kept.
void stitchSeams(const std::vector<SeamPoint>& seams, LightMap& map, const Progress& progress = Progress());

}  // namespace prelight
