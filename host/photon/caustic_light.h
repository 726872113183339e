#pragma once

#include <memory>
#include <span>

#include "photon/caustic_filter.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// `photons` towards what makes caustics, which mirrors and glass weaken before any may end by chance.
PhotonRequest causticRequest(std::uint64_t photons, std::uint64_t seed = 0);

/// Photons of caustics, sorted, and the filter that they are looked up with.
struct CausticMap {
  PhotonMaps photons;
  CausticFilter filter;
};

/// Makes the map of sorted photons; `footprint` as in chooseCausticFilter().
CausticMap makeCausticMap(PhotonMaps photons, double footprint = 0.0);

/// Sorts photons by the regions of a surface that they lie on, and makes the map.
CausticMap makeCausticMap(std::span<const device::Photon> photons, const DensitySurface& surface,
                          double footprint = 0.0);

/// A caustic map on a device.
struct CausticLight {
  CausticFilter filter;
  DensityEstimator estimator;
};

/// nullptr: the map has no photons. `surface`, which they lie on, and `device` outlive the result.
std::unique_ptr<CausticLight> makeCausticLight(const CausticMap& map, const DensitySurface& surface,
                                               const Device& device);

}  // namespace prelight
