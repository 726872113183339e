#pragma once

#include "photon/density_estimator.h"
#include "photon/photon_maps.h"

namespace prelight {

/// How the photons of caustics are looked up: the k nearest within bounds, so that the radius follows their
/// density from the focus to the dim parts. `radius` goes into every query.
struct CausticFilter {
  DensityOptions density;
  double radius = 1.0;  ///< m, the largest
};

/// The filter for photons. k follows from their number; the radius is one that nine tenths of the photons
/// find their k neighbours within; none is smaller than 1.5 times `footprint`, the width
/// in metres that a pixel or texel sees (0: as sharp as the photons allow).
CausticFilter chooseCausticFilter(const PhotonMaps& photons, double footprint = 0.0);

/// The radius, m, that nine tenths of the photons find k neighbours within, about.
double radiusOfNearest(const PhotonMaps& photons, int k);

}  // namespace prelight
