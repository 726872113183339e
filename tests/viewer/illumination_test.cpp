#include "viewer/lights/illumination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "prelight/error.h"
#include "viewer/options/group_option.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/glossy/specular_lobes.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;

TEST(TurnedSky, ByAnyAngle_IsTheRotatedSky) {
  const Environment sky = test::halvedSky();
  const SkyCoefficients straight(sky, 6);
  for (const double angle : {0.5 * pi, -0.5 * pi, 0.3, 3.0, -7.0}) {
    const auto turned = SkyCoefficients(turnedSky(sky, angle), 6).turned(0.0, 6);
    const auto expected = straight.turned(angle, 6);
    for (int l = 0; l < 6; ++l) {
      double band = 0.0;
      double difference = 0.0;
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        band += glm::dot(expected[i], expected[i]);
        difference += glm::dot(turned[i] - expected[i], turned[i] - expected[i]);
      }
      // Splitting a column between two blurs waves of degree l by at most (l texel)^2 / 8.
      const double blur = std::pow(l * 2.0 * pi / sky.width, 2) / 8.0;
      EXPECT_LE(std::sqrt(difference), blur * std::sqrt(band) + 1e-6) << angle << ' ' << l;
    }
  }
}

TEST(TurnedSky, ByHalfATexel_KeepsTheEnergyOfEveryRow) {
  Environment sky{8, 1, std::vector<glm::vec3>(8, glm::vec3(0))};
  sky.radiance[0] = glm::vec3(1);
  const Environment turned = turnedSky(sky, 2.0 * pi / 8 * 1.5);
  EXPECT_EQ(turned.radiance[6], glm::vec3(0.5f));
  EXPECT_EQ(turned.radiance[7], glm::vec3(0.5f));
  EXPECT_EQ(turned.radiance[0], glm::vec3(0.0f));
}

TEST(IncidentLight, OfASpot_HasItsConeAndRange) {
  ShadedLight spot;
  spot.kind = LightKind::Spot;
  spot.intensity = {16, 8, 4};
  spot.position = {0, 4, 0};
  spot.direction = {0, -1, 0};
  spot.coneScale = 1.0f;
  spot.coneOffset = -0.5f;
  spot.range = 8.0f;
  const IncidentLight incident = incidentFrom(spot, glm::dvec3(0.0));
  EXPECT_NEAR(glm::length(incident.toLight - glm::dvec3(0, 1, 0)), 0.0, 1e-6);
  EXPECT_NEAR(incident.irradiance.r, 16.0 / 16.0 * 0.25 * (1.0 - 1.0 / 16.0), 1e-6);
}

/// Integral over the sphere of a lobe about z times its cosine, from the lobe's linear band alone.
double cosineMoment(const LobeTable& table, int step) {
  // x_1 Y_10 is the linear band; the integral of cos Y_10 is sqrt(4 pi / 3).
  return table.bands[static_cast<std::size_t>(step * table.order) + 1].x * std::sqrt(3.0 / (4.0 * pi)) *
         std::sqrt(4.0 * pi / 3.0);
}

TEST(GgxLobe, MomentsOfAllRoughnesses_AreThoseOfTheBrdf) {
  const LobeTable table = makeLobeTable(Lobe::Ggx, 32);
  for (const int step : {32, 48, 64}) {
    const double alpha = std::pow(step / 64.0, 2);
    const double a2 = alpha * alpha;
    double whole = 0.0;
    double linear = 0.0;
    constexpr int parts = 200000;
    for (int i = 0; i < parts; ++i) {
      const double theta = pi * (i + 0.5) / parts;
      const double nh = std::cos(0.5 * theta);
      const double nl = std::max(std::cos(theta), 0.0);
      const double d = a2 / (pi * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2));
      // Masking over 4 nl nv: the masking of the light; that of the view is 1.
      const double brdf = d * 0.5 / (nl + std::sqrt(a2 + (1.0 - a2) * nl * nl));
      const double ring = 2.0 * pi * std::sin(theta) * pi / parts;
      whole += brdf * ring;
      linear += brdf * std::cos(theta) * ring;
    }
    EXPECT_NEAR(table.bands[static_cast<std::size_t>(step * 32)].x, whole, 1e-5 * whole) << step;
    EXPECT_NEAR(cosineMoment(table, step), linear, 1e-5 * std::abs(linear)) << step;
  }
}

/// Value of a lobe of the table at an angle to its axis.
double valueOf(const LobeTable& table, int step, double angle) {
  const auto* row = table.bands.data() + step * table.order;
  double value = 0.0;
  for (int l = 0; l < table.order; ++l)
    value += double(row[l].x) * (2.0 * l + 1.0) / (4.0 * pi) *
             std::legendre(static_cast<unsigned>(l), std::cos(angle));
  return value;
}

/// Angle at which half of a function's value at 0 is left.
double halfWidth(const std::function<double(double)>& f) {
  const double half = 0.5 * f(0.0);
  double angle = 0.0;
  while (angle < pi && f(angle) > half) angle += 4e-3;
  return angle;
}

/// GGX's lobe cut at an order, by quadrature over the angle.
std::vector<double> cutLobe(double roughness, int order) {
  const double alpha = roughness * roughness, a2 = alpha * alpha;
  std::vector<double> bands(static_cast<std::size_t>(order), 0.0);
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i) {
    const double theta = pi * (i + 0.5) / parts, nh = std::cos(0.5 * theta);
    const double nl = std::max(std::cos(theta), 0.0);
    const double d = a2 / (pi * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2));
    const double brdf = d * 0.5 / (nl + std::sqrt(a2 + (1.0 - a2) * nl * nl));
    for (int l = 0; l < order; ++l)
      bands[static_cast<std::size_t>(l)] += brdf * 0.5 * (2.0 * l + 1.0) * std::sin(theta) * pi / parts *
                                            std::legendre(static_cast<unsigned>(l), std::cos(theta));
  }
  return bands;
}

/// The window is as sharp as the order allows: a lobe is no wider than by a fifth than one that is cut.
TEST(GgxLobe, HalfWidth_IsThatOfTheCutLobeOfItsOrder) {
  for (const int order : {3, 4, 5, 6, 8})
    for (const int step : {6, 13, 19, 32, 45, 64}) {
      const std::vector<double> cut = cutLobe(step / 64.0, order);
      const double expected = halfWidth([&](double angle) {
        double value = 0.0;
        for (std::size_t l = 0; l < cut.size(); ++l)
          value += cut[l] * std::legendre(static_cast<unsigned>(l), std::cos(angle));
        return value;
      });
      const LobeTable table = makeLobeTable(Lobe::Ggx, order);
      const double found = halfWidth([&](double angle) { return valueOf(table, step, angle); });
      EXPECT_NEAR(found, expected, 0.2 * expected) << "order " << order << ", roughness " << step / 64.0;
    }
}

/// Where lobes still go below zero because they are narrow for their order, little is reflected through them.
TEST(GgxLobe, ThatItsOrderHolds_IsNowhereNegative) {
  for (const int order : {1, 2, 4, 6, 8}) {
    const LobeTable table = makeLobeTable(Lobe::Ggx, order);
    for (int step = 0; step < lobeSteps; ++step) {
      double trough = 0.0;
      for (int i = 0; i <= 500; ++i) trough = std::min(trough, valueOf(table, step, pi * i / 500));
      const double share = double(table.shares[static_cast<std::size_t>(step)]);
      EXPECT_GE(share * trough, -0.02 * valueOf(table, step, 0.0)) << order << ' ' << step;
    }
  }
}

TEST(GgxLobe, ShareOfTheBands_GrowsWithOrderAndRoughness) {
  float before = -1.0f;
  for (const int order : {2, 4, 6, 8}) {
    const LobeTable table = makeLobeTable(Lobe::Ggx, order);
    EXPECT_EQ(table.shares[12], 0.0f) << order;
    EXPECT_GT(table.shares.back(), 0.98f) << order;
    EXPECT_GE(table.shares[38], before) << order;
    before = table.shares[38];
  }
}

TEST(PhongLobe, Whole_IsItsClosedForm) {
  const LobeTable table = makeLobeTable(Lobe::Phong, 3);
  for (const int step : {8, 32, 48, 64}) {
    const double n = phongExponent(step / 64.0);
    EXPECT_NEAR(table.bands[static_cast<std::size_t>(step * 3)].x, (n + 2.0) / (n + 1.0), 1e-5);
  }
}

TEST(GroupOption, OneFactorOrThree_AreRead) {
  EXPECT_EQ(parseGroupFactor("Desk lamp=0.5").name, "Desk lamp");
  EXPECT_EQ(parseGroupFactor("Desk lamp=0.5").factor, glm::vec3(0.5f));
  EXPECT_EQ(parseGroupFactor("a=b=1,2,3").name, "a=b");
  EXPECT_EQ(parseGroupFactor("a=b=1,2,3").factor, glm::vec3(1, 2, 3));
}

TEST(GroupOption, AnythingElse_IsAUsageError) {
  for (const char* text : {"", "lamp", "=1", "lamp=", "lamp=1,2", "lamp=1,2,3,4", "lamp=-1", "lamp=x",
                           "lamp=nan", "lamp=inf", "lamp=1,,2", "lamp=1x"})
    EXPECT_THROW(parseGroupFactor(text), UsageError) << text;
}

}  // namespace
}  // namespace prelight::viewer
