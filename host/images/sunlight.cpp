#include "images/sunlight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "images/linear_srgb.h"

// [1] Preetham, Shirley and Smits, "A practical analytic model for daylight", 1999: Appendix A.1 and Table 2.
// [2] Wyman, Sloan and Shirley, "Simple analytic approximations to the CIE XYZ color matching functions",
//     JCGT 2(2), 2013: the sums of Gaussians.

namespace prelight {
namespace {

using std::numbers::pi;

constexpr double firstWavelength = 0.38, wavelengthStep = 0.01;  // micrometres
constexpr double luminousEfficacy = 683.0;                       // lm/W
constexpr double ozone = 0.35, water = 2.0;                      // cm, of [1]

/// A spectrum of [1] Table 2, from 0.38 to 0.75 micrometres.
using Spectrum = std::array<double, 38>;

/// Extraterrestrial radiance of the sun, 1e5 W/(m2 sr micrometre).
constexpr Spectrum sunRadiance = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                                  306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                                  253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                                  211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};

/// Absorption coefficients of ozone and of water vapour, 1/cm.
constexpr Spectrum ozoneAbsorption = {0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.003, 0.006, 0.009,
                                      0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
                                      0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048,
                                      0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
constexpr Spectrum waterAbsorption = {0.0, 0.0,   0.0,   0.0,    0.0, 0.0,  0.0,   0.0,  0.0, 0.0,
                                      0.0, 0.0,   0.0,   0.0,    0.0, 0.0,  0.0,   0.0,  0.0, 0.0,
                                      0.0, 0.0,   0.0,   0.0,    0.0, 0.0,  0.0,   0.0,  0.0, 0.0,
                                      0.0, 0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001};

double wavelengthOf(std::size_t i) { return firstWavelength + wavelengthStep * static_cast<double>(i); }

/// Interpolates a spectrum linearly.
double valueAt(const Spectrum& spectrum, double wavelength) {
  const double at = std::clamp((wavelength - firstWavelength) / wavelengthStep, 0.0,
                               static_cast<double>(spectrum.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), spectrum.size() - 2);
  return std::lerp(spectrum[i], spectrum[i + 1], at - static_cast<double>(i));
}

/// Returns a Gaussian with different widths below and above its centre; nanometres.
double bell(double wavelength, double centre, double below, double above) {
  const double t = (wavelength - centre) * (wavelength < centre ? below : above);
  return std::exp(-0.5 * t * t);
}

/// Returns the colour matching functions at a wavelength in micrometres ([2], Eq. 4).
glm::dvec3 colourMatching(double wavelength) {
  const double nm = 1000.0 * wavelength;
  return {0.362 * bell(nm, 442.0, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
              0.065 * bell(nm, 501.1, 0.0490, 0.0382),
          0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
          1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725)};
}

}  // namespace

double airMassAt(double elevation) {
  const double degrees = 90.0 - elevation * 180.0 / pi;  // zenith angle
  return 1.0 / (std::sin(elevation) + 0.15 * std::pow(93.885 - degrees, -1.253));
}

double airTransmittance(double wavelength, double airMass, double turbidity) {
  const double haze = 0.04608 * turbidity - 0.04586;  // Angstrom's turbidity coefficient
  const double molecules = 0.008735 * std::pow(wavelength, -4.08);
  const double aerosols = std::max(haze, 0.0) * std::pow(wavelength, -1.3);
  const double vapour = valueAt(waterAbsorption, wavelength) * water * airMass;
  return std::exp(-airMass * (molecules + aerosols + valueAt(ozoneAbsorption, wavelength) * ozone) -
                  0.2385 * vapour / std::pow(1.0 + 20.07 * vapour, 0.45));
}

glm::dvec3 sunIrradiance(double turbidity, double elevation) {
  const double airMass = airMassAt(elevation);
  const double solidAngle = 2.0 * pi * (1.0 - std::cos(sunRadius));
  glm::dvec3 xyz(0.0);
  for (std::size_t i = 0; i < sunRadiance.size(); ++i) {
    const double wavelength = wavelengthOf(i);
    const double arriving = 1e5 * sunRadiance[i] * airTransmittance(wavelength, airMass, turbidity);
    xyz += wavelengthStep * arriving * colourMatching(wavelength);
  }
  return linearSrgb(luminousEfficacy / 1000.0 * solidAngle * xyz);
}

}  // namespace prelight
