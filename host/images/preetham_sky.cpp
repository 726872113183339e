#include "images/preetham_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "images/linear_srgb.h"
#include "images/sunlight.h"
#include "prelight/error.h"

// [1] Preetham, Shirley and Smits, "A practical analytic model for daylight", 1999: Appendix A.2.

namespace prelight {
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
