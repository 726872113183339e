#pragma once

#include <glm/glm.hpp>
#include <span>

#include "prelight/transfer.h"

namespace prelight {

/// The horizon, radians, above which as much of a sector's cosine-weighted sky lies as is open, which is
/// cos^2 of it. What is not 0..1 is taken to be the nearer of the two.
double horizonOfOpenness(double open);

/// Horizons of sectors that are as open as this or, where that is not 0..1, as nearly so as all of them
/// together let them be.
void horizonsOfOpenness(std::span<const double> open, std::span<float> horizons);

/// How open a place is whose sectors have these horizons: its ambient occlusion.
double accessibilityOf(std::span<const float> horizons);

/// The horizon in a direction whose azimuth is `turn`, radians, between those of the middles of sectors.
double horizonTowards(std::span<const float> horizons, double turn);

/// Irradiance over pi from a sky, RGB a coefficient of SH of order 3, above horizons that are even within a
/// sector: closed form. `frame` is that of the place (surfaceFrame). Max, "Horizon mapping: shadows for
/// bump-mapped surfaces", 1988, has the horizons; the sky in SH is ours.
glm::dvec3 skyAboveHorizons(std::span<const glm::dvec3> sky, const glm::dmat3& frame,
                            std::span<const float> horizons);

/// How much of an even disk of an angular radius > 0 lies above a horizon whose edge is straight; `height`:
/// of its middle over that, both radians.
double diskAboveHorizon(double height, double radius);

}  // namespace prelight
