#pragma once

#include <glm/glm.hpp>
#include <span>

#include "prelight/transfer.h"

namespace prelight {

/// The horizon, radians, above which as much of a sector's cosine-weighted sky lies as is open, which is
/// cos^2 of it. What is not 0..1 is taken to be the nearer of the two.
double horizonOfOpenness(double open);

/// What the rays of a sector met, cosine-weighted: shares of as many as a sector has in the mean.
struct SectorRays {
  double open = 0.0;    ///< escaped
  double closed = 0.0;  ///< did not
  double height = 0.0;  ///< did not, each times the squared sine of its angle above the tangent plane
};

/// What is closed of each sector, as one band of heights, whose foot is 0 but where most of it clearly hangs
/// above what is open. A sector is as open as its own rays say, so that one where all escaped, or none did,
/// is exact however many there were; the odds of the others have one factor, such that all sectors together
/// are as open as the mean of their rays. What fits leave below 0 counts as 0.
void closedBands(std::span<const SectorRays> rays, std::span<float> feet, std::span<float> horizons);

/// How open a place is whose sectors have these bands: its ambient occlusion. Feet: none, or one a horizon.
double accessibilityOf(std::span<const float> feet, std::span<const float> horizons);

/// The horizon, or foot, in a direction whose azimuth is `turn`, radians, between those of the middles of
/// sectors.
double horizonTowards(std::span<const float> horizons, double turn);

/// Irradiance over pi from a sky, RGB a coefficient of SH of order 3, past bands that are even within a
/// sector: closed form. `frame` is that of the place (surfaceFrame). Max, "Horizon mapping: shadows for
/// bump-mapped surfaces", 1988, has the horizons; their feet and the sky in SH are ours.
glm::dvec3 skyAboveHorizons(std::span<const glm::dvec3> sky, const glm::dmat3& frame,
                            std::span<const float> feet, std::span<const float> horizons);

/// How much of an even disk of an angular radius > 0 lies above a horizon whose edge is straight; `height`:
/// of its middle over that, both radians.
double diskAboveHorizon(double height, double radius);

/// How much of it is seen past a band; of one that hangs, of a foot above 0, with edges as straight as they
/// are cheap.
double diskPastBand(double height, double radius, double foot, double horizon);

}  // namespace prelight
