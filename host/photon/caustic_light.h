#pragma once

#include <memory>
#include <span>

#include "photon/caustic_filter.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// Returns a request for `photons` aimed at objects that make caustics. Mirrors and glass attenuate their
/// power before Russian roulette begins.
PhotonRequest causticRequest(std::uint64_t photons, std::uint64_t seed = 0);

/// Sorted caustic photons with the filter of their look-up.
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

/// Uploads a map. Returns nullptr for a map without photons. `surface`, which the photons lie on, and
/// `device` must outlive the result.
std::unique_ptr<CausticLight> makeCausticLight(const CausticMap& map, const DensitySurface& surface,
                                               const Device& device);

}  // namespace prelight
