#pragma once

#include <algorithm>

namespace prelight {

/// Returns a sky's light, which rings where little of it arrives: no less than a share of that of the sky
/// smoothed until it is negative nowhere, which is above 0 wherever any of it arrives. For one channel;
/// kernels/core/ringing_funcs.cl is the same on devices.
inline double withoutRinging(double light, double smoothed) { return std::max(light, 0.25 * smoothed); }

}  // namespace prelight
