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
  double length = 0.0;  ///< of the edge that it stands for, m
};

/// Points along every edge where the surface goes on at less than the crease angle (scene/surface_regions.h)
/// and the map does not, two per texel and more; without those where a wall stands on the edge. The scene is
/// the one that the tracer was made of.
std::vector<SeamPoint> seamsOf(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                               double creaseAngle);

/// The texel that counts most in a look-up.
std::uint32_t nearestTexel(const LightMapLookUp& at);

/// Root of the mean square, over the length of the seams and the channels, of the difference between the
/// irradiance on both sides, W/m2.
double seamJump(const LightMap& map, const std::vector<SeamPoint>& seams);

/// Moves the values of texels beside seams as little as makes both sides agree: least squares of the jumps
/// and, by a twentieth of their weight, of the changes (Iwanicki 2013, "Lighting technology of The Last of
/// Us", of the same aim). Irradiance does not fall below 0. Texels apart from seams keep their values. Throws
/// Interrupted between coefficients, which are kept.
void stitchSeams(const std::vector<SeamPoint>& seams, LightMap& map, const Progress& progress = Progress());

}  // namespace prelight
