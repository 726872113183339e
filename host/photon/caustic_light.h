#pragma once

#include <memory>
#include <vector>

#include "photon/caustic_filter.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// The light of caustics, ready to be looked up on surfaces.
struct CausticLight {
  CausticFilter filter;
  DensityEstimator estimator;
};

/// `photons` towards what makes caustics, which mirrors and glass weaken before any may end by chance.
PhotonRequest causticRequest(std::uint64_t photons, std::uint64_t seed = 0);

/// The light of caustic photons that have landed, with the filter for a `footprint` in metres
/// (chooseCausticFilter). nullptr: there are none. `surface` and `device` outlive the result.
std::unique_ptr<CausticLight> makeCausticLight(const std::vector<device::Photon>& photons,
                                               const DensitySurface& surface, double footprint,
                                               const Device& device);

/// Sends `photons` towards what makes caustics and chooses the filter for a `footprint` in metres
/// (chooseCausticFilter). nullptr: none landed. Throws Interrupted. `surface` and `device` outlive the
/// result.
std::unique_ptr<CausticLight> traceCausticLight(const CompiledScene& compiled, TransportScene& scene,
                                                const DensitySurface& surface, std::uint64_t photons,
                                                std::uint64_t seed, double footprint, const Device& device,
                                                Progress& progress, PhotonReport& report);

}  // namespace prelight
