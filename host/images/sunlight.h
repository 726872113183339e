#pragma once

#include <glm/glm.hpp>

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

}  // namespace prelight
