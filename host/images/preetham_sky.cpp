#include "images/preetham_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/colour.h"
#include "prelight/error.h"

// [1] Preetham, Shirley and Smits, "A practical analytic model for daylight", 1999: Appendix A and Table 2.
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

namespace {

using std::numbers::pi;

constexpr int skyHeight = 256;
constexpr int skyWidth = 2 * skyHeight;
/// Least cosine of the zenith angle; the value at the horizon is a limit.
constexpr double leastCosine = 1e-3;

/// Distribution of luminance (kcd/m2) or of chromaticity x or y over the sky: a function by Perez et al. of
/// the angles to zenith and sun, times the value at the zenith.
struct Distribution {
  std::array<double, 5> c{};
  double scale = 0.0;

  double shape(double cosineToZenith, double angleToSun) const {
    const double cosine = std::cos(angleToSun);
    return (1.0 + c[0] * std::exp(c[1] / std::max(cosineToZenith, leastCosine))) *
           (1.0 + c[2] * std::exp(c[3] * angleToSun) + c[4] * cosine * cosine);
  }
};

using TurbidityLines = std::array<std::array<double, 2>, 5>;  ///< [coefficient]{per turbidity, constant}
/// [turbidity^2, ^1, ^0][power of the sun's zenith angle: 3 ... 0].
using ZenithRows = std::array<std::array<double, 4>, 3>;

constexpr TurbidityLines luminanceLines = {
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}};
constexpr TurbidityLines xLines = {
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}}};
constexpr TurbidityLines yLines = {
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}}};
constexpr ZenithRows xRows = {{{0.00166, -0.00375, 0.00209, 0.0},
                               {-0.02903, 0.06377, -0.03202, 0.00394},
                               {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithRows yRows = {{{0.00275, -0.00610, 0.00317, 0.0},
                               {-0.04214, 0.08970, -0.04153, 0.00516},
                               {0.15346, -0.26756, 0.06670, 0.26688}}};

double zenithLuminance(double turbidity, double sunAngle) {
  const double chi = (4.0 / 9.0 - turbidity / 120.0) * (pi - 2.0 * sunAngle);
  return (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
}

double zenithChromaticity(const ZenithRows& rows, double turbidity, double sunAngle) {
  double sum = 0.0;
  for (const std::array<double, 4>& row : rows) {
    double ofAngle = 0.0;
    for (const double value : row) ofAngle = ofAngle * sunAngle + value;
    sum = sum * turbidity + ofAngle;
  }
  return sum;
}

Distribution distributionOf(const TurbidityLines& lines, double turbidity, double sunAngle, double zenith) {
  Distribution distribution;
  for (std::size_t i = 0; i < lines.size(); ++i) distribution.c[i] = lines[i][0] * turbidity + lines[i][1];
  distribution.scale = zenith / distribution.shape(1.0, sunAngle);
  return distribution;
}

/// Converts luminance and chromaticities to linear sRGB. Colours outside the gamut are clipped.
glm::dvec3 rgbOf(double luminance, double x, double y) {
  const double perY = luminance / std::max(y, 1e-3);
  return linearSrgb({x * perY, luminance, (1.0 - x - y) * perY});
}

glm::dvec3 towardsSun(const DaySky& day) {
  return {std::sin(day.azimuth) * std::cos(day.elevation), std::sin(day.elevation),
          -std::cos(day.azimuth) * std::cos(day.elevation)};
}

class Daylight {
 public:
  explicit Daylight(const DaySky& day) : toSun_(towardsSun(day)) {
    const double t = day.turbidity, angle = 0.5 * pi - day.elevation;
    luminance_ = distributionOf(luminanceLines, t, angle, std::max(zenithLuminance(t, angle), 0.0));
    x_ = distributionOf(xLines, t, angle, zenithChromaticity(xRows, t, angle));
    y_ = distributionOf(yLines, t, angle, zenithChromaticity(yRows, t, angle));
  }

  glm::dvec3 radiance(const glm::dvec3& direction) const {
    const double toSun = std::acos(std::clamp(glm::dot(direction, toSun_), -1.0, 1.0));
    const auto at = [&](const Distribution& d) { return d.scale * d.shape(direction.y, toSun); };
    return rgbOf(std::max(at(luminance_), 0.0), at(x_), at(y_));
  }

 private:
  glm::dvec3 toSun_;
  Distribution luminance_, x_, y_;
};

void check(const char* what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw UsageError(what, "got " + std::to_string(value) + ", expected " + std::to_string(least) + " to " +
                               std::to_string(most));
}

/// Adds the sun's disk, which is smaller than a texel, to the texels that it covers, by evenly spread points
/// of the disk above the horizon. Returns the irradiance on level ground.
glm::dvec3 addSun(const DaySky& day, Environment& sky) {
  constexpr int points = 4096;
  const glm::dvec3 each = sunIrradiance(day.turbidity, day.elevation) / double(points);
  const glm::dvec3 axis = towardsSun(day);
  const glm::dvec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(side, axis);
  const double golden = pi * (3.0 - std::sqrt(5.0));
  glm::dvec3 ground(0.0);
  for (int i = 0; i < points; ++i) {
    const double radius = sunRadius * std::sqrt((i + 0.5) / points);
    const glm::dvec3 direction =
        glm::normalize(axis + radius * (std::cos(golden * i) * side + std::sin(golden * i) * up));
    if (direction.y <= 0.0) continue;
    const glm::dvec2 at = Environment::coordinates(direction);
    const int row = std::min(static_cast<int>(at.y * skyHeight), skyHeight / 2 - 1);
    const int column = std::min(static_cast<int>(at.x * skyWidth), skyWidth - 1);
    const double solidAngle =
        (std::cos(pi * row / skyHeight) - std::cos(pi * (row + 1) / skyHeight)) * 2.0 * pi / skyWidth;
    sky.radiance[static_cast<std::size_t>(row) * skyWidth + column] += glm::vec3(each / solidAngle);
    ground += direction.y * each;
  }
  return ground;
}

}  // namespace

Environment daySky(const DaySky& day) {
  check("DaySky::turbidity", day.turbidity, 2.0, 10.0);
  check("DaySky::elevation", day.elevation, 0.0, 0.5 * pi);
  check("DaySky::groundAlbedo", day.groundAlbedo, 0.0, 1.0);
  check("DaySky::azimuth", day.azimuth, -8.0, 8.0);
  const Daylight light(day);
  Environment sky{skyWidth, skyHeight, {}};
  sky.radiance.resize(static_cast<std::size_t>(skyWidth) * skyHeight);
  glm::dvec3 irradiance(0.0);
  for (int row = 0; row < skyHeight / 2; ++row) {
    const double polar = pi * (row + 0.5) / skyHeight;
    const double weight = std::sin(polar) * std::cos(polar) * (pi / skyHeight) * (2.0 * pi / skyWidth);
    for (int column = 0; column < skyWidth; ++column) {
      const glm::dvec3 radiance =
          light.radiance(Environment::direction((column + 0.5) / skyWidth, (row + 0.5) / skyHeight));
      sky.radiance[static_cast<std::size_t>(row) * skyWidth + column] = glm::vec3(radiance);
      irradiance += weight * radiance;
    }
  }
  if (day.sun) irradiance += addSun(day, sky);
  std::fill(sky.radiance.begin() + static_cast<std::ptrdiff_t>(sky.radiance.size() / 2), sky.radiance.end(),
            glm::vec3(day.groundAlbedo / pi * irradiance));
  return sky;
}

}  // namespace prelight
