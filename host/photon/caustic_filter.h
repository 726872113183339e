#pragma once

#include "photon/density_estimator.h"
#include "photon/photon_maps.h"

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

}  // namespace prelight
