#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"

namespace prelight {

/// Returns `count` receivers per place for FinalGather, [place][receiver], whose rays continue the place's
/// sequence.
std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed);

/// The normal of a receiver that a density query uses.
enum class AroundNormal : std::uint8_t { Geometric, Shading };

/// Returns queries of a density estimate at receivers, with a largest radius in metres. `patches`,
/// [receiver], is the result of SurfacePatches::at(); if empty, the photons of whole regions count.
std::vector<device::DensityQuery> densityQueries(std::span<const device::Receiver> receivers,
                                                 AroundNormal normal, double radius,
                                                 std::span<const std::uint32_t> patches);

/// Returns queries at places of the surface, with geometric normals.
std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius,
                                                 std::span<const std::uint32_t> patches);

}  // namespace prelight
