#include "basis/lights/sh_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr int order = sh::maxOrder;
constexpr int count = order * order;
constexpr double y00 = 0.28209479177387814;

using Coefficients = std::vector<double>;

double worstDifference(const Coefficients& a, const Coefficients& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

Coefficients polygon(const std::vector<glm::dvec3>& vertices) {
  Coefficients out(count);
  sh::polygonLight(vertices, order, out);
  return out;
}

/// Integral of Y cos / r^2 over the area of a parallelogram lamp: the sum that a renderer would form.
Coefficients parallelogramByArea(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
                                 int nodes) {
  Coefficients out(count, 0.0);
  Coefficients values(count);
  const glm::dvec3 normal = glm::cross(a, b);
  const auto rule = gaussLegendre(nodes);
  for (const LineSample& u : rule) {
    for (const LineSample& v : rule) {
      const glm::dvec3 p = corner + 0.5 * (1.0 + u.position) * a + 0.5 * (1.0 + v.position) * b;
      const double r = glm::length(p);
      sh::evaluate(p / r, order, values);
      const double weight = 0.25 * u.weight * v.weight * std::abs(glm::dot(normal, p)) / (r * r * r);
      for (int i = 0; i < count; ++i) out[i] += weight * values[i];
    }
  }
  return out;
}

/// Integral of Y cos / r^2 over the area of a disk lamp, in polar coordinates.
Coefficients diskByArea(const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up, int nodes) {
  Coefficients out(count, 0.0);
  Coefficients values(count);
  const glm::dvec3 normal = glm::cross(right, up);
  for (const LineSample& u : gaussLegendre(nodes)) {
    const double radius = 0.5 * (1.0 + u.position);
    for (int k = 0; k < 3 * nodes; ++k) {
      const double t = 2.0 * pi * k / (3 * nodes);
      const glm::dvec3 p = centre + radius * (std::cos(t) * right + std::sin(t) * up);
      const double r = glm::length(p);
      sh::evaluate(p / r, order, values);
      const double weight =
          0.5 * u.weight * radius * 2.0 * pi / (3 * nodes) * std::abs(glm::dot(normal, p)) / (r * r * r);
      for (int i = 0; i < count; ++i) out[i] += weight * values[i];
    }
  }
  return out;
}

TEST(ShLights, DirectionalAndPoint_AreDeltas) {
  const glm::dvec3 position(1.0, -2.0, 2.0);
  Coefficients expected(count);
  sh::evaluate(position / 3.0, order, expected);
  Coefficients out(count);
  sh::directionalLight(position, order, out);
  EXPECT_LT(worstDifference(out, expected), 1e-14);
  sh::pointLight(position, order, out);
  for (double& v : expected) v /= 9.0;
  EXPECT_LT(worstDifference(out, expected), 1e-14);
}

TEST(ShLights, Cap_AnyAngle_MatchesQuadrature) {
  for (const double angle : {0.01, 0.3, 1.0, pi / 2, 2.0, 3.1}) {
    std::vector<double> zonal(order);
    sh::capZonal(angle, zonal);
    std::vector<double> expected(order, 0.0);
    Coefficients values(count);
    for (const LineSample& s : gaussLegendre(40)) {
      const double z = 1.0 - 0.5 * (1.0 + s.position) * (1.0 - std::cos(angle));
      sh::evaluate({std::sqrt(1.0 - z * z), 0.0, z}, order, values);
      for (int l = 0; l < order; ++l) {
        expected[l] += pi * s.weight * (1.0 - std::cos(angle)) * values[l * (l + 1)];
      }
    }
    for (int l = 0; l < order; ++l) EXPECT_NEAR(zonal[l], expected[l], 1e-13) << angle << " " << l;
  }
}

TEST(ShLights, Cap_Tiny_KeepsItsDigits) {
  // To first order the integral over a tiny cap is its solid angle times Y_l0 of the pole.
  for (const double angle : {1e-4, 1e-8, 1e-150}) {
    std::vector<double> zonal(order);
    sh::capZonal(angle, zonal);
    const double solidAngle = 4.0 * pi * std::pow(std::sin(0.5 * angle), 2);
    for (int l = 0; l < order; ++l) {
      const double expected = solidAngle * std::sqrt((2.0 * l + 1.0) / (4.0 * pi));
      // The next term of the series is l (l + 1) angle^2 / 8.
      EXPECT_NEAR(zonal[l] / expected, 1.0, 1e-13 + 0.13 * l * (l + 1.0) * angle * angle)
          << angle << " " << l;
    }
  }
}

TEST(ShLights, Cap_WholeSphere_IsAConstant) {
  std::vector<double> zonal(order);
  sh::capZonal(pi, zonal);
  EXPECT_NEAR(zonal[0], 4.0 * pi * y00, 1e-14);
  for (int l = 1; l < order; ++l) EXPECT_NEAR(zonal[l], 0.0, 1e-14);
}

TEST(ShLights, Sphere_SeenFromOutside_IsTheCapOfItsAngle) {
  Coefficients sphere(count);
  Coefficients cap(count);
  sh::sphereLight({0.0, 3.0, 4.0}, 2.5, order, sphere);
  sh::capLight({0.0, 0.6, 0.8}, pi / 6, order, cap);
  EXPECT_LT(worstDifference(sphere, cap), 1e-13);
}

TEST(ShLights, Sphere_FromWithin_IsEverywhere) {
  Coefficients sphere(count);
  sh::sphereLight({0.0, 0.3, 0.4}, 2.5, order, sphere);
  EXPECT_NEAR(sphere[0], 4.0 * pi * y00, 1e-13);
  for (int i = 1; i < count; ++i) EXPECT_NEAR(sphere[i], 0.0, 1e-13);
}

TEST(ShLights, Polygon_Octant_HasAnEighthOfTheSphereAndOfTheAxes) {
  const Coefficients octant = polygon({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR(octant[0], 0.5 * pi * y00, 1e-14);
  // The integral of z over the octant is pi / 4.
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(octant[i], std::sqrt(0.75 / pi) * pi / 4, 1e-14);
}

TEST(ShLights, Polygon_EightOctants_AreEverywhere) {
  Coefficients sum(count, 0.0);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        const Coefficients octant = polygon({{x, 0, 0}, {0, y, 0}, {0, 0, z}});
        for (int i = 0; i < count; ++i) sum[i] += octant[i];
      }
    }
  }
  EXPECT_NEAR(sum[0], 4.0 * pi * y00, 1e-13);
  for (int i = 1; i < count; ++i) EXPECT_NEAR(sum[i], 0.0, 1e-13) << i;
}

TEST(ShLights, Polygon_Rectangles_MatchTheAreaIntegral) {
  struct Case {
    glm::dvec3 corner;
    glm::dvec3 a;
    glm::dvec3 b;
  };
  const Case cases[] = {{{-1.0, 2.0, -1.5}, {2.0, 0.0, 0.0}, {0.0, 0.3, 3.0}},
                        {{0.2, -0.4, 1.0}, {1.0, 0.5, 0.1}, {-0.3, 1.0, 0.2}},
                        {{-2.0, -2.0, 1.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0}},
                        {{3.0, 0.1, 0.2}, {0.0, 0.25, 0.0}, {0.0, 0.0, 0.2}}};
  for (const Case& c : cases) {
    const Coefficients out = polygon({c.corner, c.corner + c.a, c.corner + c.a + c.b, c.corner + c.b});
    EXPECT_LT(worstDifference(out, parallelogramByArea(c.corner, c.a, c.b, 120)), 1e-12);
  }
}

/// Integral of Y over the spherical triangle of three unit vectors. It sums points of the flat triangle
/// between them, whose plane must not contain the origin.
Coefficients triangleByArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int nodes) {
  Coefficients out(count, 0.0);
  Coefficients values(count);
  const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
  const auto rule = gaussLegendre(nodes);
  for (const LineSample& u : rule) {
    for (const LineSample& v : rule) {
      const double s = 0.5 * (1.0 + u.position);
      const double t = 0.5 * (1.0 + v.position);
      const glm::dvec3 p = (1.0 - s) * a + s * (1.0 - t) * b + s * t * c;
      const double r = glm::length(p);
      sh::evaluate(p / r, order, values);
      const double weight = 0.25 * u.weight * v.weight * s * volume / (r * r * r);
      for (int i = 0; i < count; ++i) out[i] += weight * values[i];
    }
  }
  return out;
}

TEST(ShLights, Polygon_TrianglesOfAllShapes_MatchTheAreaIntegral) {
  const auto unit = [](double x, double y, double z) { return glm::normalize(glm::dvec3(x, y, z)); };
  const std::vector<glm::dvec3> triangles[] = {
      {unit(1.0, 0.0, 0.3), unit(-0.5, 0.87, 0.3), unit(-0.5, -0.87, 0.3)},  // Almost a hemisphere.
      {unit(1.0, 0.0, 0.0), unit(-0.9, 0.3, 0.1), unit(0.0, -0.2, 1.0)},     // An edge of almost half a turn.
      {unit(0.3, 0.4, -1.0), unit(0.31, 0.4, -1.0), unit(-0.8, 0.9, 0.2)},   // A sliver.
      {unit(0.0, 0.0, -1.0), unit(1e-9, 1.0, 0.0), unit(-1.0, -1e-9, -0.5)}};  // A pole as a corner.
  for (const auto& t : triangles) {
    EXPECT_LT(worstDifference(polygon(t), triangleByArea(t[0], t[1], t[2], 320)), 1e-12) << t[0].x;
  }
}

TEST(ShLights, Polygon_Reversed_IsTheSame) {
  const glm::dvec3 a(0.2, -0.4, 1.0);
  const glm::dvec3 b(1.0, 0.5, 0.1);
  const glm::dvec3 c(-0.3, 1.0, 0.2);
  EXPECT_LT(worstDifference(polygon({a, b, c}), polygon({c, b, a})), 1e-14);
}

TEST(ShLights, Polygon_SmallAndReversed_IsTheSame) {
  const glm::dvec3 a(2, 1, 3), b = a + 1e-4 * glm::dvec3(1, 0, 0), c = a + 1e-4 * glm::dvec3(0, 1, 0.5);
  const Coefficients one = polygon({a, b, c}), other = polygon({c, b, a});
  EXPECT_GT(one[0], 0.0);
  EXPECT_GT(other[0], 0.0);
  EXPECT_LT(worstDifference(one, other), 1e-12 * one[0]);
}

TEST(ShLights, Polygon_Concave_IsTheSumOfItsParts) {
  // The polygon is an L of three unit squares at height 1.
  const auto at = [](double x, double y) { return glm::dvec3(x - 0.7, y - 0.6, 1.0); };
  const Coefficients whole = polygon({at(0, 0), at(2, 0), at(2, 1), at(1, 1), at(1, 2), at(0, 2)});
  const Coefficients wide = polygon({at(0, 0), at(2, 0), at(2, 1), at(0, 1)});
  const Coefficients top = polygon({at(0, 1), at(1, 1), at(1, 2), at(0, 2)});
  for (int i = 0; i < count; ++i) EXPECT_NEAR(whole[i], wide[i] + top[i], 1e-13) << i;
}

TEST(ShLights, Polygon_TinySquare_KeepsRelativeDigits) {
  for (const double size : {0.05, 1e-3, 1e-6}) {
    const glm::dvec3 corner(1.0, 2.0, 2.0);
    const glm::dvec3 a(size, 0.0, 0.0);
    const glm::dvec3 b(0.0, size, -size);
    const Coefficients out = polygon({corner, corner + a, corner + a + b, corner + b});
    const Coefficients expected = parallelogramByArea(corner, a, b, 12);
    // The corners themselves are rounded to 1e-16 of their distance.
    EXPECT_LT(worstDifference(out, expected) / expected[0], 1e-13 + 3e-15 / size) << size;
  }
}

TEST(ShLights, Polygon_AroundTheThresholdOfSmallness_BothMethodsAgree) {
  // The larger square is integrated along its outline; its four quarters count as small.
  const auto at = [](double x, double y) { return glm::dvec3(1.0, x, y); };
  constexpr double s = 0.13;
  const Coefficients whole = polygon({at(0, 0), at(s, 0), at(s, s), at(0, s)});
  Coefficients sum(count, 0.0);
  for (const double x : {0.0, s / 2}) {
    for (const double y : {0.0, s / 2}) {
      const Coefficients quarter =
          polygon({at(x, y), at(x + s / 2, y), at(x + s / 2, y + s / 2), at(x, y + s / 2)});
      for (int i = 0; i < count; ++i) sum[i] += quarter[i];
    }
  }
  EXPECT_LT(worstDifference(whole, sum), 1e-14);
}

TEST(ShLights, Disk_SeenAlongItsAxis_IsACap) {
  Coefficients disk(count);
  Coefficients cap(count);
  sh::diskLight({0.0, 2.0, 0.0}, {0.0, -1.0, 0.0}, 1.5, order, disk);
  sh::capLight({0.0, 1.0, 0.0}, std::atan(0.75), order, cap);
  EXPECT_LT(worstDifference(disk, cap), 1e-13);
}

TEST(ShLights, Disk_SeenFromTheSide_MatchesTheAreaIntegral) {
  const glm::dvec3 centre(1.0, 0.5, 2.0);
  const glm::dvec3 right(0.8, 0.0, 0.0);
  const glm::dvec3 up(0.0, 0.8, 0.0);
  Coefficients disk(count);
  sh::diskLight(centre, {0.0, 0.0, 1.0}, 0.8, order, disk);
  EXPECT_LT(worstDifference(disk, diskByArea(centre, right, up, 60)), 1e-12);
}

TEST(ShLights, Disk_SeenFromItsPlane_IsNothing) {
  Coefficients disk(count);
  sh::diskLight({2.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.8, order, disk);
  for (const double v : disk) EXPECT_EQ(v, 0.0);
}

TEST(ShLights, LightsThatAreNone_AreUsageErrors) {
  std::vector<double> out(9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sh::directionalLight({0, 0, 0}, 3, out), UsageError);
  EXPECT_THROW(sh::pointLight({nan, 0, 0}, 3, out), UsageError);
  EXPECT_THROW(sh::pointLight({1, 0, 0}, 0, out), UsageError);
  EXPECT_THROW(sh::capLight({1, 0, 0}, -0.1, 3, out), UsageError);
  EXPECT_THROW(sh::capLight({1, 0, 0}, nan, 3, out), UsageError);
  EXPECT_THROW(sh::sphereLight({1, 0, 0}, 0.0, 3, out), UsageError);
  EXPECT_THROW(sh::diskLight({1, 0, 0}, {0, 0, 0}, 1.0, 3, out), UsageError);
  EXPECT_THROW(sh::diskLight({1, 0, 1e-9}, {0, 0, 1}, 1.0, 3, out), UsageError);
  const std::vector<glm::dvec3> two = {{1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(sh::polygonLight(two, 3, out), UsageError);
  const std::vector<glm::dvec3> through = {{1, 0, 0}, {-2, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(sh::polygonLight(through, 3, out), UsageError);
}

TEST(ShZonal, CosinePower_MatchesQuadratureAndItsIntegralIsOne) {
  for (const double exponent : {0.0, 1.0, 2.0, 7.0, 50.0}) {
    std::vector<double> zonal(order);
    sh::cosinePowerZonal(exponent, zonal);
    EXPECT_NEAR(zonal[0], y00, 1e-15);
    std::vector<double> expected(order, 0.0);
    Coefficients values(count);
    for (const LineSample& s : gaussLegendre(60)) {
      const double z = 0.5 * (1.0 + s.position);
      sh::evaluate({std::sqrt(1.0 - z * z), 0.0, z}, order, values);
      const double weight = 0.5 * s.weight * (exponent + 1.0) * std::pow(z, exponent);
      for (int l = 0; l < order; ++l) expected[l] += weight * values[l * (l + 1)];
    }
    for (int l = 0; l < order; ++l) EXPECT_NEAR(zonal[l], expected[l], 1e-13) << exponent << " " << l;
  }
}

TEST(ShZonal, CosinePower_OfNoExponent_IsRefused) {
  std::vector<double> zonal(order);
  for (const double exponent :
       {-0.5, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(sh::cosinePowerZonal(exponent, zonal), UsageError) << exponent;
}

TEST(ShZonal, Convolve_WithTheClampedCosine_IsIrradiance) {
  Coefficients a(count);
  sh::capLight(glm::normalize(glm::dvec3(1, 2, 3)), 0.5, order, a);
  Coefficients b = a;
  std::vector<double> zonal(order);
  sh::cosinePowerZonal(1.0, zonal);  // max(cos, 0) / pi.
  sh::convolve(a, zonal);
  sh::irradianceFromRadiance(b, order);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(pi * a[i], b[i], 1e-14);
}

TEST(ShZonal, Irradiance_OfACapOverhead_IsPiSinSquared) {
  Coefficients cap(count);
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.2, 0.9, -0.3));
  sh::capLight(up, 0.7, order, cap);
  sh::irradianceFromRadiance(cap, order);
  EXPECT_NEAR(sh::reconstruct(cap, order, up), pi * std::pow(std::sin(0.7), 2), 1e-3);
}

}  // namespace
}  // namespace prelight
