#include "images/preetham_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

// [1] Preetham, Shirley and Smits 1999, Appendix A.1 and Table 2.

namespace prelight {
namespace {

using std::numbers::pi;

double luminanceOf(const glm::dvec3& rgb) { return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// [1] A.1 term by term, at wavelengths of Table 2 whose absorptions are 8.5 (ozone, 0.55) and 100 (vapour,
// 0.72) per metre. Turbidity is 3; there is half again as much air as from the zenith.
TEST(Sunlight, Transmittance_IsThePapersProduct) {
  const double mass = 1.5, haze = 0.04608 * 3.0 - 0.04586;
  const double green = std::exp(-0.008735 * std::pow(0.55, -4.08) * mass) *
                       std::exp(-haze * std::pow(0.55, -1.3) * mass) * std::exp(-8.5 * 0.0035 * mass);
  EXPECT_NEAR(airTransmittance(0.55, mass, 3.0), green, 1e-12);
  const double red = std::exp(-0.008735 * std::pow(0.72, -4.08) * mass) *
                     std::exp(-haze * std::pow(0.72, -1.3) * mass) * std::exp(-1.4 * 0.0035 * mass) *
                     std::exp(-0.2385 * 2.0 * mass / std::pow(1.0 + 20.07 * 2.0 * mass, 0.45));
  EXPECT_NEAR(airTransmittance(0.72, mass, 3.0), red, 1e-12);
}

// [1] A.1; Kasten's table has 1.995 at 60 degrees from the zenith, 5.60 at 80 and about 37 at the horizon.
TEST(Sunlight, AirMass_IsKastens) {
  EXPECT_NEAR(airMassAt(0.5 * pi), 1.0, 1e-3);
  EXPECT_NEAR(airMassAt(30.0 * pi / 180.0), 1.995, 0.005);
  EXPECT_NEAR(airMassAt(10.0 * pi / 180.0), 5.60, 0.03);
  EXPECT_NEAR(airMassAt(0.0), 36.5, 0.5);
}

// A high sun sends about 100 thousand lux through clear air (128 to 134 thousand above the air). A low sun is
// dim and red.
TEST(Sunlight, Irradiance_IsThatOfDays) {
  const double high = luminanceOf(sunIrradiance(2.0, 70.0 * pi / 180.0));
  EXPECT_GT(high, 90.0);
  EXPECT_LT(high, 120.0);
  const glm::dvec3 low = sunIrradiance(3.0, 5.0 * pi / 180.0), noon = sunIrradiance(3.0, 60.0 * pi / 180.0);
  EXPECT_LT(luminanceOf(low), 0.3 * luminanceOf(noon));
  EXPECT_GT(low.r / low.b, 3.0 * noon.r / noon.b);
  EXPECT_GT(luminanceOf(noon), luminanceOf(sunIrradiance(6.0, 60.0 * pi / 180.0)));
}

/// Sum over texels of radiance x solid angle x cosine to `normal`, taken at texel centres.
glm::dvec3 irradianceOf(const Environment& sky, const glm::dvec3& normal) {
  glm::dvec3 sum(0.0);
  for (int row = 0; row < sky.height; ++row) {
    const double top = std::cos(pi * row / sky.height), bottom = std::cos(pi * (row + 1) / sky.height);
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 w = Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
      sum += std::max(glm::dot(w, normal), 0.0) * (top - bottom) * 2.0 * pi / sky.width *
             glm::dvec3(sky.radiance[static_cast<std::size_t>(row) * sky.width + column]);
    }
  }
  return sum;
}

// The irradiance does not depend on the texels that the sun's disk falls into.
TEST(Sunlight, DiskInTheMap_SendsItsIrradiance_WhereverItStands) {
  for (const double elevation : {0.05, 0.6, 1.2, 0.5 * pi}) {
    DaySky day{3.0, elevation, 2.0, 0.0};
    const Environment without = daySky(day);
    day.sun = true;
    const glm::dvec3 towards(std::sin(2.0) * std::cos(elevation), std::sin(elevation),
                             -std::cos(2.0) * std::cos(elevation));
    const glm::dvec3 added = irradianceOf(daySky(day), towards) - irradianceOf(without, towards);
    const glm::dvec3 wanted = sunIrradiance(3.0, elevation);
    EXPECT_LT(glm::distance(added, wanted), 2e-3 * glm::length(wanted)) << elevation;
  }
}

TEST(Sunlight, HalfSetSun_SendsTheHalfThatIsAboveTheHorizon_AndLightsTheGround) {
  DaySky day{3.0, 0.0, 2.0, 0.0};
  const glm::dvec3 towards(std::sin(2.0), 0.0, -std::cos(2.0));
  const Environment without = daySky(day);
  day.sun = true;
  const glm::dvec3 added = irradianceOf(daySky(day), towards) - irradianceOf(without, towards);
  const glm::dvec3 half = 0.5 * sunIrradiance(3.0, 0.0);
  EXPECT_LT(glm::distance(added, half), 0.02 * glm::length(half) + 1e-6);
  day = {3.0, 0.8, 0.0, 0.5, true};
  const Environment sunny = daySky(day);
  const double ground = luminanceOf(glm::dvec3(sunny.radiance.back()));
  EXPECT_NEAR(ground, 0.5 / pi * luminanceOf(irradianceOf(sunny, {0, 1, 0})), 0.01 * ground);
}

}  // namespace
}  // namespace prelight
