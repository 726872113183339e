#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"

namespace prelight {

/// `count` receivers at every place, for FinalGather, whose rays go on in the place's sequence.
std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed);

/// Which normal of a receiver a density query has.
enum class AroundNormal : std::uint8_t { Geometric, Shading };

/// Queries of a density estimate at receivers, with a largest radius in metres. `patches`: [receiver] those
/// of SurfacePatches::at(); empty: photons of whole regions count.
std::vector<device::DensityQuery> densityQueries(std::span<const device::Receiver> receivers,
                                                 AroundNormal normal, double radius,
                                                 std::span<const std::uint32_t> patches);

/// Queries at places of the surface, with geometric normals.
std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius,
                                                 std::span<const std::uint32_t> patches);

}  // namespace prelight
