#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "encodings/analytic_light.h"
#include "encodings/direction_fit.h"
#include "encodings/encodings.h"
#include "encodings/least_squares.h"
#include "encodings/registry/registry.h"
#include "support/mapped_irradiance.h"

namespace prelight {
namespace {

using test::LightSum;

using std::numbers::pi;

std::vector<float> encodedValues(const Encoding& encoding, const std::vector<float>& incident,
                                 const glm::dmat3& frame) {
  std::vector<float> values(encoding.values);
  encoding.encode(incident, glm::mat3(frame), values);
  return values;
}

/// Calls `visit(direction, solid angle)` over a fine grid of the hemisphere (`lowest` 0) or the sphere.
template <typename Visit>
void overSphere(double lowest, Visit visit) {
  constexpr int rows = 400, columns = 400;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double z = lowest + (1.0 - lowest) * (row + 0.5) / rows, radius = std::sqrt(1.0 - z * z);
      const double phi = 2.0 * pi * (column + 0.5) / columns;
      visit(glm::dvec3(radius * std::cos(phi), radius * std::sin(phi), z),
            2.0 * pi * (1.0 - lowest) / (rows * columns));
    }
}

TEST(HBasis, FunctionsOverTheHemisphere_AreOrthonormal) {
  std::array<std::array<double, 6>, 6> products{};
  overSphere(0.0, [&](const glm::dvec3& d, double solidAngle) {
    const std::array<float, 6> h = hBasis(glm::vec3(d));
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) products[i][j] += solidAngle * double(h[i]) * double(h[j]);
  });
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(products[i][j], i == j ? 1.0 : 0.0, 2e-5) << i << ' ' << j;
}

/// Where irradiance lies in the span of the functions, the stored numbers are integrals of irradiance times
/// the functions.
TEST(HBasis, CoefficientsOfAnEvenSky_AreItsProjection) {
  const glm::dmat3 frame = test::obliqueFrame();
  const std::vector<float> values = encodedValues(
      *encodingNamed("h-basis-6"), LightSum(test::surfaceLights().front(), frame).incident(), frame);
  std::array<double, 6> wanted{};
  overSphere(0.0, [&](const glm::dvec3& d, double solidAngle) {
    const std::array<float, 6> h = hBasis(glm::vec3(d));
    for (std::size_t i = 0; i < 6; ++i) wanted[i] += solidAngle * double(h[i]) * 0.5 * pi * (1.0 + d.z);
  });
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values[3 * i + 2], wanted[i], 1e-3) << i;
}

/// A polynomial of degree 8 replaces the integral. Errors are relative to the lobe's greatest irradiance.
TEST(SphericalGaussians, IrradianceOfALobe_IsTheIntegralOfItsRadiance) {
  for (const auto& [count, bound] :
       {std::pair<std::size_t, double>{6, 1e-5}, {9, 1.5e-5}, {12, 7e-5}, {24, 1e-3}}) {
    const GaussianLobes& lobes = gaussianLobes(count);
    double worst = 0.0, greatest = 0.0;
    for (int step = 0; step <= 20; ++step) {
      const double angle = pi * step / 20.0, x = std::cos(angle);
      const glm::dvec3 axis(std::sin(angle), 0.0, x);  // The normal is z.
      double wanted = 0.0;
      overSphere(0.0, [&](const glm::dvec3& d, double solidAngle) {
        wanted += solidAngle * d.z * std::exp(double(lobes.sharpness) * (glm::dot(d, axis) - 1.0));
      });
      double found = 0.0;
      for (std::size_t i = lobes.irradiance.size() - 1; i > 1; --i)
        found = (found + double(lobes.irradiance[i])) * x * x;
      found += double(lobes.irradiance[0]) + double(lobes.irradiance[1]) * x;
      worst = std::max(worst, std::abs(found - wanted));
      greatest = std::max(greatest, wanted);
    }
    EXPECT_LT(worst, bound * greatest) << count << ": " << worst / greatest;
    EXPECT_GT(worst, 0.3 * bound * greatest) << count << ": " << worst / greatest;
  }
}

TEST(SphericalGaussians, Lobes_AreUnitVectorsSpreadOverTheHemisphere) {
  for (const std::size_t count : {6, 9, 12, 24}) {
    const GaussianLobes& lobes = gaussianLobes(count);
    ASSERT_EQ(lobes.directions.size(), count);
    glm::dvec3 mean(0.0);
    for (const glm::vec3& d : lobes.directions) {
      EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
      EXPECT_GT(d.z, 0.0f);
      mean += glm::dvec3(d) / static_cast<double>(count);
    }
    EXPECT_NEAR(mean.z, 0.5, 1e-6);
    EXPECT_LT(std::hypot(mean.x, mean.y), 0.12);
  }
}

TEST(SphericalGaussians, Radiance_IsNeverNegative) {
  const glm::dmat3 frame = test::obliqueFrame();
  for (const test::AnalyticLight& light : test::surfaceLights())
    for (const float value : encodedValues(*encodingNamed("sg-12"), LightSum(light, frame).incident(), frame))
      EXPECT_GE(value, 0.0f) << light.name;
}

/// The encoding must equal the light map's own reconstruction from its directions.
TEST(SkyAndLamp, Irradiance_IsThatOfLightMapsDirections) {
  const glm::dmat3 frame = test::obliqueFrame();
  const Encoding& encoding = *encodingNamed("sky-and-lamp");
  for (const test::AnalyticLight& light : test::surfaceLights()) {
    const LightSum sum(light, frame);
    const std::vector<float> incident = sum.incident(), values = encodedValues(encoding, incident, frame);
    MapLight map;
    map[0] = sum.irradiance(frame[2]);
    for (std::size_t i = 0; i < 4; ++i)
      map[i + 1] = {incident[i], incident[incidentTerms + i], incident[2 * incidentTerms + i]};
    for (const glm::dvec3& normal : test::normalsWithin(80.0, frame, 30)) {
      const glm::dvec3 wanted = mappedIrradiance(map, frame[2], normal);
      const glm::dvec3 found(encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal)));
      EXPECT_LT(glm::distance(found, wanted), 2e-3 * glm::length(map[0])) << light.name;
    }
  }
}

/// ZH3 can hold radiance whose quadratic band is zonal, and reproduces it exactly.
TEST(Zh3, LightWithOneAxis_IsExact) {
  const glm::dmat3 frame = test::obliqueFrame();
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.4, 0.2, 0.8));
  const test::AnalyticLight light{"zonal", [&](const glm::dvec3& d) {
                                    const double x = glm::dot(d, axis);
                                    return glm::dvec3(2.0 + x + x * x, 1.0 + 0.5 * x,
                                                      1.0 + 0.9 * x - 0.1 * x * x);
                                  }};
  const LightSum sum(light, frame);
  const Encoding& encoding = *encodingNamed("zh3");
  const std::vector<float> values = encodedValues(encoding, sum.incident(), frame);
  for (const glm::dvec3& normal : test::normalsWithin(180.0, frame, 40)) {
    const glm::dvec3 wanted = sum.irradiance(normal);
    const glm::dvec3 found(encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal)));
    EXPECT_LT(glm::distance(found, wanted), 1e-3 * glm::length(wanted));
  }
}

/// For a lamp, the paper's curve is evaluated where the linear over the constant coefficient is sqrt(3). K is
/// then 1.938 of the constant coefficient.
TEST(Zh3, HallucinatedLamp_HasTheCurvesCoefficient) {
  const double constant = std::sqrt(1.0 / (4.0 * pi)), linear = std::sqrt(3.0 / (4.0 * pi));
  std::vector<float> values(12, 0.0f);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    values[channel] = static_cast<float>(constant);
    values[6 + channel] = static_cast<float>(linear);  // Along z.
  }
  const double k = constant * (0.08 * std::sqrt(3.0) + 0.6 * 3.0);
  for (const double x : {1.0, 0.5, 0.0}) {
    const double wanted = pi * constant * constant + 2.0 * pi / 3.0 * linear * linear * x +
                          pi / 4.0 * std::sqrt(5.0 / (16.0 * pi)) * k * (3.0 * x * x - 1.0);
    const glm::vec3 normal(std::sqrt(1.0 - x * x), 0.0, x);
    EXPECT_NEAR(encodingNamed("zh3-hallucinated")->irradiance(values, glm::mat3(1.0f), normal).y,
                std::max(wanted, 0.0), 1e-5);
  }
}

/// The colour of a face is the irradiance for a normal that points out of it.
TEST(AmbientCube, NormalsAlongAxes_SeeOneFaceAlone) {
  const Encoding& encoding = *encodingNamed("ambient-cube");
  std::vector<float> values(18);
  for (std::size_t i = 0; i < 18; ++i) values[i] = static_cast<float>(i + 1);
  for (int face = 0; face < 6; ++face) {
    glm::vec3 normal(0.0f);
    normal[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
    const glm::vec3 found = encoding.irradiance(values, glm::mat3(1.0f), normal);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_EQ(found[channel], static_cast<float>(3 * face + channel + 1));
  }
}

/// Along each vector only its own colour counts, because the three vectors are at right angles.
TEST(HalfLife2, NormalsAlongItsVectors_SeeOneColourAlone) {
  const Encoding& encoding = *encodingNamed("half-life-2");
  const glm::mat3 frame(test::obliqueFrame());
  const std::vector<float> values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const float z = 1.0f / std::sqrt(3.0f);
  const std::array<glm::vec3, 3> vectors = {glm::vec3(std::sqrt(2.0f / 3.0f), 0, z),
                                            glm::vec3(-1 / std::sqrt(6.0f), 1 / std::sqrt(2.0f), z),
                                            glm::vec3(-1 / std::sqrt(6.0f), -1 / std::sqrt(2.0f), z)};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 found = encoding.irradiance(values, frame, frame * vectors[i]);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(found[channel], values[3 * i + static_cast<std::size_t>(channel)], 1e-4f);
  }
}

/// Encodings with one direction find the direction of a single lamp.
TEST(Directions, OfALamp_PointThere) {
  const glm::dmat3 frame = test::obliqueFrame();
  const double tilt = 40.0 * pi / 180.0;
  const glm::dvec3 wanted =
      frame * glm::dvec3(std::sin(tilt) * std::cos(tilt), std::sin(tilt) * std::sin(tilt), std::cos(tilt));
  for (const char* name : {"trilight", "dominant-direction", "ahd"}) {
    const std::vector<float> values =
        encodedValues(*encodingNamed(name), LightSum(test::lamp(10.0, 40.0), frame).incident(), frame);
    const glm::dvec3 found(storedDirection(values, glm::vec3(0.0f)));
    EXPECT_LT(glm::distance(found, wanted), 0.06) << name;
  }
}

/// Rms difference from the reference sums, relative to the irradiance at the surface's own normal.
double errorOf(const char* name, const test::AnalyticLight& light) {
  const glm::dmat3 frame = test::obliqueFrame();
  const LightSum sum(light, frame);
  const Encoding& encoding = *encodingNamed(name);
  const std::vector<float> values = encodedValues(encoding, sum.incident(), frame);
  double squares = 0.0;
  const std::vector<glm::dvec3> normals = test::normalsWithin(45.0, frame, 60);
  for (const glm::dvec3& normal : normals) {
    const glm::dvec3 found(encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal)));
    squares += glm::dot(found - sum.irradiance(normal), found - sum.irradiance(normal));
  }
  return std::sqrt(squares / static_cast<double>(normals.size())) / glm::length(sum.irradiance(frame[2]));
}

/// Lamps of unlike colours, far apart, are held by as many stored lamps; one fewer does not hold them.
TEST(Directions, OfSeveralLamps_AreHeldByAsMany) {
  const auto one = test::lamp(10.0, 50.0).radiance;
  const auto red = [one](const glm::dvec3& d) { return glm::dvec3(2.0, 0.2, 0.1) * one(d); };
  const auto blue = [one](const glm::dvec3& d) { return glm::dvec3(0.1, 0.3, 1.5) * one({-d.x, -d.y, d.z}); };
  const auto green = [one](const glm::dvec3& d) { return glm::dvec3(0.2, 1.5, 0.2) * one({-d.y, d.x, d.z}); };
  const test::AnalyticLight two{"two lamps", [=](const glm::dvec3& d) { return red(d) + blue(d); }};
  const test::AnalyticLight three{"three lamps",
                                  [=](const glm::dvec3& d) { return red(d) + blue(d) + green(d); }};
  EXPECT_LT(errorOf("dominant-directions-2", two), 0.02);
  EXPECT_GT(errorOf("dominant-direction", two), 4.0 * errorOf("dominant-directions-2", two));
  EXPECT_LT(errorOf("dominant-directions-3", three), 0.02);
  EXPECT_GT(errorOf("dominant-directions-2", three), 2.0 * errorOf("dominant-directions-3", three));
}

/// Between a texel with a lamp and one without, the lamp's direction stays.
TEST(Directions, MixedWithDarkness_StayWhereTheyWere) {
  const glm::dmat3 frame = test::obliqueFrame();
  for (const char* name :
       {"trilight", "dominant-direction", "dominant-directions-2", "dominant-directions-3", "ahd"}) {
    const Encoding& encoding = *encodingNamed(name);
    std::vector<float> values =
        encodedValues(encoding, LightSum(test::lamp(10.0, 40.0), frame).incident(), frame);
    const std::vector<float> whole = values;
    for (float& value : values) value *= 0.25f;
    for (const glm::dvec3& normal : test::normalsWithin(60.0, frame, 10)) {
      const glm::vec3 one = encoding.irradiance(whole, glm::mat3(frame), glm::vec3(normal)),
                      quarter = encoding.irradiance(values, glm::mat3(frame), glm::vec3(normal));
      EXPECT_LT(glm::distance(0.25f * one, quarter), 1e-5f) << name;
    }
  }
}

/// The best solution over all choices of which unknowns may differ from 0, each solved by elimination.
std::vector<double> bestOfAllChoices(const std::vector<double>& matrix, const std::vector<double>& right) {
  const std::size_t n = right.size();
  std::vector<double> best(n, 0.0);
  double least = 0.0;
  for (unsigned choice = 1; choice < (1u << n); ++choice) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < n; ++i)
      if ((choice >> i) & 1u) used.push_back(i);
    std::vector<std::vector<double>> rows;
    for (const std::size_t i : used) {
      rows.emplace_back();
      for (const std::size_t j : used) rows.back().push_back(matrix[i * n + j]);
      rows.back().push_back(right[i]);
    }
    for (std::size_t p = 0; p < used.size(); ++p)
      for (std::size_t r = 0; r < used.size(); ++r) {
        if (r == p) continue;
        const double factor = rows[r][p] / rows[p][p];
        for (std::size_t k = 0; k <= used.size(); ++k) rows[r][k] -= factor * rows[p][k];
      }
    std::vector<double> x(n, 0.0);
    bool allowed = true;
    for (std::size_t p = 0; p < used.size(); ++p) {
      x[used[p]] = rows[p].back() / rows[p][p];
      allowed = allowed && x[used[p]] >= 0.0;
    }
    double error = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      error -= 2.0 * right[i] * x[i];
      for (std::size_t j = 0; j < n; ++j) error += matrix[i * n + j] * x[i] * x[j];
    }
    if (!allowed || error >= least) continue;
    least = error;
    best = x;
  }
  return best;
}

TEST(LeastSquares, NonNegativeSolutions_AreTheBestOfAllChoices) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int bounded = 0;
  for (int round = 0; round < 200; ++round) {
    constexpr std::size_t n = 6, m = 9;
    std::vector<double> columns(n * m), matrix(n * n), right(n), found(n);
    for (double& value : columns) value = normal(random);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < m; ++k) matrix[i * n + j] += columns[i * m + k] * columns[j * m + k];
    for (double& value : right) value = normal(random);
    solveLeastSquares(matrix, right, found, 0);
    const std::vector<double> wanted = bestOfAllChoices(matrix, right);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(found[i], wanted[i], 1e-8);
      bounded += wanted[i] == 0.0;
    }
  }
  EXPECT_GT(bounded, 200);
}

TEST(LeastSquares, FunctionTwice_IsUsedOnce) {
  const std::vector<double> matrix = {2.0, 2.0, 2.0, 2.0}, right = {4.0, 4.0};
  std::vector<double> found(2);
  for (const std::size_t free : {0, 1, 2}) {
    solveLeastSquares(matrix, right, found, free);
    EXPECT_NEAR(found[0] + found[1], 2.0, 1e-12) << free;
  }
}

TEST(FitNormals, Weights_IntegratePolynomials) {
  double one = 0.0, z4 = 0.0, x2y2 = 0.0;
  for (const FitNormal& normal : fitNormals()) {
    const glm::dvec3& d = normal.direction;
    EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    one += normal.weight;
    z4 += normal.weight * std::pow(d.z, 4);
    x2y2 += normal.weight * d.x * d.x * d.y * d.y;
  }
  EXPECT_NEAR(one, 1.0, 1e-12);
  EXPECT_NEAR(z4, 1.0 / 3.0, 1e-12);  // 2 x the integral of z^5.
  // The mean of cos^2 sin^2 is 1/8; 2 x the integral of z (1 - z^2)^2 is 1/3.
  EXPECT_NEAR(x2y2, 1.0 / 24.0, 1e-12);
}

}  // namespace
}  // namespace prelight
