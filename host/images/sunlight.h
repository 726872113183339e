#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Half the angle of the sun's disk, rad: 0.533 degrees across.
constexpr double sunRadius = 0.00465;

/// Share of the sun's light of a wavelength (micrometres) that passes the air, of which it crosses `airMass`
/// times as much as from the zenith. Turbidity 1 is air without haze.
double airTransmittance(double wavelength, double airMass, double turbidity);

/// That factor for a sun at an elevation, rad, 0 or above: 1 at the zenith, 37 at the horizon.
double airMassAt(double elevation);

/// What a surface that faces the sun gets from its disk through the air: linear sRGB of which a luminance of
/// 1 is 1000 lx.
glm::dvec3 sunIrradiance(double turbidity, double elevation);

}  // namespace prelight
