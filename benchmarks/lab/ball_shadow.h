#pragma once

#include <vector>

namespace prelight {

/// The shadow of a ball on a plane under a round light straight above, after "PRT quality" of Kautz (2004).
/// It shows how spherical harmonics blur shadows of lights of several sizes. The ball has a radius of 0.4 m,
/// its middle is 1 m above the plane. `distance` is that on the plane from the point below the ball, m.
/// `lightAngle` is the light's diameter in radians, 0 (a point) to below pi.
namespace ball_shadow {

constexpr double farthest = 1.5;  ///< largest distance at which errors are measured, m

/// Returns the zonal coefficients about the vertical, [band], of visibility times the clamped cosine, in
/// closed form. The order is at most 31.
std::vector<double> transfer(double distance, int order);

/// Return irradiance as a share of that of open ground, by SH of an order and exactly.
double bySh(double distance, double lightAngle, int order);
double exact(double distance, double lightAngle);

/// Returns the RMS of their difference over evenly spaced points from the middle to `farthest`.
double error(double lightAngle, int order);

}  // namespace ball_shadow
}  // namespace prelight
