#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gi/final_gather.h"
#include "gi/irradiance_cache.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

struct CachedGatherRequest {
  std::uint32_t rays = 128;  ///< of a record, a power of two from 8 on
  std::uint64_t seed = 0;
  std::uint32_t width = 1;  ///< of the map that the places are texels of
  IrradianceCacheOptions cache;
};

/// Irradiance at texels, W/m2, [place], of which some are gathered at and the others interpolated: first
/// those of a coarse grid, then of finer ones what no record has reached. `records`: how many were gathered
/// at.
std::vector<glm::vec3> gatherCached(FinalGather& gather, const CompiledScene& compiled,
                                    std::span<const LightMapTexel> places, const CachedGatherRequest& request,
                                    Progress& progress, std::size_t& records);

}  // namespace prelight
