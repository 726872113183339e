#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gi/final_gather.h"
#include "gi/irradiance_cache.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Options of gatherCached().
struct CachedGatherRequest {
  std::uint32_t rays = 128;  ///< rays per record, a power of two, at least 8
  std::uint64_t seed = 0;
  std::uint32_t width = 1;  ///< width of the map whose texels the places are
  IrradianceCacheOptions cache;
};

/// Returns the irradiance at texels, W/m2, [place], gathered at some texels and interpolated at the others:
/// first at those of a coarse grid, then, on finer grids, at texels that no record reaches. `records`
/// receives the number of texels gathered at.
std::vector<glm::vec3> gatherCached(FinalGather& gather, const CompiledScene& compiled,
                                    std::span<const LightMapTexel> places, const CachedGatherRequest& request,
                                    Progress& progress, std::size_t& records);

}  // namespace prelight
