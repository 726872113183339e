#pragma once

#include <cstdint>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"
#include "prelight/techniques.h"

namespace prelight {

struct OcclusionMapRequest {
  OcclusionLimits limits = {};
  std::vector<ShadowSetRequest> shadowSets = {};
  std::uint32_t rays = 512;  ///< a texel, a power of two, 16 to 8192
  std::uint64_t seed = 0;
};

struct OcclusionMapReport {
  std::uint64_t rays = 0;
  std::size_t places = 0;  ///< of the surface that the error was found at
  double error = 0.0;      ///< rms at these, of what a look-up shows
};

/// Ambient occlusion of a scene texel by texel: cosine-weighted accessibility, 0..1, in all three channels.
/// It is cast at the texels and spread over their cells as light is; texels inside objects take after their
/// neighbours, and seams are stitched. Its error is found at places that have no part in the map, twice each
/// with random numbers of their own. Throws UsageError for a shadow set that names no node, Interrupted.
LightMap makeOcclusionMap(const CompiledScene& scene, const LightMapLayout& layout,
                          const OcclusionMapRequest& request, const Device& device, Progress& progress,
                          OcclusionMapReport& report);

}  // namespace prelight
