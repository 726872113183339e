#pragma once

#include <glm/glm.hpp>

#include "prelight/picture.h"

namespace prelight {

/// Angular radius of the sun's disk, rad; its diameter is 0.533 degrees.
constexpr double sunRadius = 0.00465;

/// Returns the share of sunlight of a wavelength (micrometres) that passes the atmosphere along a path of
/// `airMass` times the vertical one. Turbidity 1 is air without haze.
double airTransmittance(double wavelength, double airMass, double turbidity);

/// Returns the air mass for an elevation of the sun, rad, >= 0: 1 at the zenith, 37 at the horizon.
double airMassAt(double elevation);

/// Returns the irradiance of the sun's disk through the atmosphere on a surface that faces it, in linear sRGB
/// where a luminance of 1 is 1000 lx.
glm::dvec3 sunIrradiance(double turbidity, double elevation);

/// A cloudless day by the model of Preetham, Shirley and Smits (1999).
struct DaySky {
  double turbidity = 3.0;     ///< haze of the air: 2 is clear, 10 hazy
  double elevation = 0.8;     ///< angle of the sun above the horizon, rad, 0 to pi/2
  double azimuth = 0.0;       ///< direction of the sun, rad: from -Z towards +X
  double groundAlbedo = 0.2;  ///< albedo of the uniform ground below the horizon
  bool sun = false;           ///< whether the sun's disk is added to the sky
};

/// Returns the map of a day. Radiance 1 is a luminance of 1000 cd/m2. Throws UsageError for numbers out of
/// range.
Environment daySky(const DaySky& day);

}  // namespace prelight
