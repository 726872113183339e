#pragma once

#include <vector>

namespace prelight {

/// The shadow of a ball on a plane under a round light straight above, after "PRT quality" of Kautz (2004):
/// what spherical harmonics make of lights of several sizes. The ball has a radius of 0.4 m, its middle is 1
/// m above the plane. `distance` on the plane is from the place below it, m; `lightAngle` the light's
/// diameter in radians, 0 to below pi, 0 a point.
namespace ball_shadow {

constexpr double farthest = 1.5;  ///< m: where errors are looked at

/// Zonal coefficients about the vertical, [band], of visibility times the clamped cosine: closed forms. The
/// order is at most 31.
std::vector<double> transfer(double distance, int order);

/// Irradiance over that of open ground, by SH of an order and without.
double bySh(double distance, double lightAngle, int order);
double exact(double distance, double lightAngle);

/// RMS of their difference over places that are even from the middle to the farthest.
double error(double lightAngle, int order);

}  // namespace ball_shadow
}  // namespace prelight
