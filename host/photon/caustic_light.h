#pragma once

#include <memory>
#include <span>

#include "photon/density_estimator.h"
#include "photon/photon_maps.h"
#include "photon/photon_tracer.h"

namespace prelight {

/// Look-up of caustic photons: the k nearest within bounds, so that the radius adapts to their density
/// between focus and dim parts. `radius` goes into every query.
struct CausticFilter {
  DensityOptions density;
  double radius = 1.0;  ///< largest radius, m
};

/// Chooses the filter for photons. k follows from their number. Nine tenths of the photons have k neighbours
/// within the radius, which is at least 1.5 times `footprint`, the width in metres of a pixel or texel (0: as
/// sharp as the photons permit).
CausticFilter chooseCausticFilter(const PhotonMaps& photons, double footprint = 0.0);

/// Returns the approximate radius, m, within which nine tenths of the photons have k neighbours.
double radiusOfNearest(const PhotonMaps& photons, int k);

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
