#pragma once

namespace prelight {

/// The cone about a direction that lets as much of a cosine-weighted even sky through as `accessibility` says
/// (Akenine-Moller et al., "Real-Time Rendering", 4th edition, 2018, 11.3.4 and 11.4). What of it lies below
/// the horizon is closed. `cosine`: of the surface's normal and the axis. Returns the cosine of half the
/// cone's angle, 0..1: 0 is the widest cone, 1 a cone that is closed.
double coneAperture(double accessibility, double cosine);

}  // namespace prelight
