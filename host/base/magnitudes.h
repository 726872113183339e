#pragma once

namespace prelight {

/// Largest coordinate (m), radiance (W/(m2 sr)) and intensity (W/sr, W/m2) that is accepted from a file or an
/// option. Squares of these, sums of squares and products of two are well within the range of 32-bit floats
/// (3e38), in which values computed from them are stored; the sun's radiance is 2e7 W/(m2 sr), a light year
/// 1e16 m.
constexpr double largestInput = 1e15;

/// Largest number that a baked file may contain: multiplied by a sky of largestInput it is still finite.
constexpr double largestBaked = 1e18;

}  // namespace prelight
