#pragma once

#include <glm/glm.hpp>
#include <span>

#include "prelight/transfer.h"

namespace prelight {

/// Returns the horizon, in radians, above which the open share of a sector's cosine-weighted sky lies; the
/// share is cos^2 of the horizon. `open` is clamped to 0..1.
double horizonOfOpenness(double open);

/// Cosine-weighted sums over the rays of a sector, relative to the mean number of rays per sector.
struct SectorRays {
  double open = 0.0;    ///< rays that escaped
  double closed = 0.0;  ///< rays that did not
  double height = 0.0;  ///< rays that did not, times the squared sine of their angle above the tangent plane
};

/// Fits the occluded part of each sector as one band of elevations. Its foot is 0 unless most of the band is
/// clearly above open directions. The openness of a sector follows from its own rays, so that a sector in
/// which all or no rays escaped is exact; the odds of other sectors have a common factor such that all
/// sectors together are as open as the mean of their rays. Negative sums, which fits may produce, count as 0.
void closedBands(std::span<const SectorRays> rays, std::span<float> feet, std::span<float> horizons);

/// Returns the ambient occlusion of a place with these bands. There are no feet, or one per horizon.
double accessibilityOf(std::span<const float> feet, std::span<const float> horizons);

/// Returns the horizon or foot at azimuth `turn`, radians, interpolated between the middles of sectors.
double horizonTowards(std::span<const float> horizons, double turn);

/// Returns irradiance over pi from a sky, given as RGB per SH coefficient of order 3, past bands that are
/// constant within a sector, in closed form. `frame` is surfaceFrame() of the place. Horizons are those of
/// Max, "Horizon mapping: shadows for bump-mapped surfaces", 1988; feet and the sky in SH are new.
glm::dvec3 skyAboveHorizons(std::span<const glm::dvec3> sky, const glm::dmat3& frame,
                            std::span<const float> feet, std::span<const float> horizons);

/// Returns the share of a uniform disk of an angular radius > 0 above a horizon with a straight edge.
/// `height` is that of its centre above the horizon. Both are in radians.
double diskAboveHorizon(double height, double radius);

/// Returns the share of the disk that is visible past a band, which for a foot above 0 is bounded by two
/// straight edges.
double diskPastBand(double height, double radius, double foot, double horizon);

}  // namespace prelight
