#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "basis/cube_map.h"
#include "basis/quadrature.h"
#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;

template <typename Radiance>
Environment makeSky(int width, int height, Radiance radiance) {
  Environment sky{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      sky.radiance.push_back(radiance(Environment::direction((column + 0.5) / width, (row + 0.5) / height)));
    }
  }
  return sky;
}

/// Projection by definition, with a product quadrature in each texel: the reference for the separable
/// projection.
std::vector<double> projectByDefinition(const Environment& sky, int order) {
  const int count = sh::coefficientCount(order);
  std::vector<double> result(3 * static_cast<std::size_t>(count), 0.0);
  std::vector<double> values(count);
  const auto nodes = gaussLegendre(10);
  for (int row = 0; row < sky.height; ++row) {
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 radiance(sky.radiance[row * sky.width + column]);
      for (const LineSample& down : nodes) {
        for (const LineSample& across : nodes) {
          const double v = (row + 0.5 + 0.5 * down.position) / sky.height;
          const double u = (column + 0.5 + 0.5 * across.position) / sky.width;
          const double area = 0.25 * down.weight * across.weight * 2.0 * pi / sky.width * pi / sky.height;
          sh::evaluate(Environment::direction(u, v), order, values);
          for (int i = 0; i < 3 * count; ++i) {
            result[i] += radiance[i / count] * area * std::sin(pi * v) * values[i % count];
          }
        }
      }
    }
  }
  return result;
}

TEST(ShEnvironment, Project_ConstantSky_IsOnlyTheFirstCoefficient) {
  const Environment sky = makeSky(64, 32, [](const glm::dvec3&) { return glm::vec3(1.0f, 2.0f, 0.5f); });
  const auto c = sh::projectEnvironment(sky, 4);
  EXPECT_NEAR(c[0], std::sqrt(4.0 * pi), 1e-12);
  EXPECT_NEAR(c[16], 2.0 * std::sqrt(4.0 * pi), 1e-12);
  EXPECT_NEAR(c[32], 0.5 * std::sqrt(4.0 * pi), 1e-12);
  for (int i = 1; i < 16; ++i) EXPECT_NEAR(c[i], 0.0, 1e-12) << i;
}

TEST(ShEnvironment, Project_OneTexelSky_IsOnlyTheFirstCoefficient) {
  for (const int order : {1, 8, sh::maxOrder}) {
    const auto c = sh::projectEnvironment(constantEnvironment(glm::vec3(3.0f)), order);
    EXPECT_NEAR(c[0], 3.0 * std::sqrt(4.0 * pi), 1e-12);
    for (int i = 1; i < order * order; ++i) EXPECT_NEAR(c[i], 0.0, 1e-11) << order << " " << i;
  }
}

TEST(ShEnvironment, Project_LinearSky_HasItsClosedForm) {
  // L = 2 + y + z/2 - x/4 projects to 2 sqrt(4 pi) and sqrt(4 pi / 3) (1, 1/2, -1/4) on (y, z, x).
  const Environment sky = makeSky(256, 128, [](const glm::dvec3& w) {
    return glm::vec3(static_cast<float>(2.0 + w.y + 0.5 * w.z - 0.25 * w.x));
  });
  const auto c = sh::projectEnvironment(sky, 3);
  const double linear = std::sqrt(4.0 * pi / 3.0);
  EXPECT_NEAR(c[0], 2.0 * std::sqrt(4.0 * pi), 1e-3);
  EXPECT_NEAR(c[1], linear, 1e-3);
  EXPECT_NEAR(c[2], 0.5 * linear, 1e-3);
  EXPECT_NEAR(c[3], -0.25 * linear, 1e-3);
  for (int i = 4; i < 9; ++i) EXPECT_NEAR(c[i], 0.0, 1e-3) << i;
}

TEST(ShEnvironment, Project_BrightTexel_PointsWhereTheTexelLooks) {
  // A quarter of the width right of the centre, on the equator, is +X; the top row is +Y; the centre is -Z.
  const auto peak = [](int row, int column) {
    Environment sky{64, 33, std::vector<glm::vec3>(64 * 33, glm::vec3(0.0f))};
    sky.radiance[row * 64 + column] = glm::vec3(1.0f);
    const auto c = sh::projectEnvironment(sky, 2);
    return glm::normalize(glm::dvec3(c[3], c[1], c[2]));
  };
  EXPECT_GT(peak(16, 48).x, 0.99);
  EXPECT_GT(peak(0, 5).y, 0.99);
  EXPECT_LT(peak(32, 5).y, -0.99);
  EXPECT_LT(peak(16, 32).z, -0.99);
  EXPECT_LT(peak(16, 16).x, -0.99);
}

TEST(ShEnvironment, Project_AnySky_MatchesTheDefinition) {
  const Environment sky = makeSky(37, 18, [](const glm::dvec3& w) {
    return glm::vec3(std::exp(3.0 * w.x), 1.0 + w.y * w.z, std::abs(w.z));
  });
  for (const int order : {1, 3, 8}) {
    const auto fast = sh::projectEnvironment(sky, order);
    const auto slow = projectByDefinition(sky, order);
    ASSERT_EQ(fast.size(), slow.size());
    for (std::size_t i = 0; i < fast.size(); ++i) EXPECT_NEAR(fast[i], slow[i], 1e-11) << order << " " << i;
  }
}

/// Projection by definition: the radiance of the texel in each direction, at Gauss points of a much finer
/// grid.
std::vector<double> projectCubeByDefinition(const CubeMap& map, int order, int pieces) {
  const int count = sh::coefficientCount(order);
  std::vector<double> result(3 * static_cast<std::size_t>(count), 0.0);
  std::vector<double> values(count);
  const auto rule = gaussLegendre(6);
  const int cells = map.faceSize * pieces;
  for (int cell = 0; cell < cubeFaces * cells * cells; ++cell) {
    for (int node = 0; node < 36; ++node) {
      const LineSample& across = rule[node % 6];
      const LineSample& down = rule[node / 6];
      const double u = (cell % cells + 0.5 + 0.5 * across.position) / cells;
      const double v = (cell / cells % cells + 0.5 + 0.5 * down.position) / cells;
      const double r2 = 1.0 + (2 * u - 1) * (2 * u - 1) + (2 * v - 1) * (2 * v - 1);
      const double area = across.weight * down.weight / (cells * cells) / (r2 * std::sqrt(r2));
      const glm::dvec3 w = cubeDirection(cell / (cells * cells), u, v);
      const glm::dvec3 radiance(map.radiance[cubeTexel(w, map.faceSize)]);
      sh::evaluate(w, order, values);
      for (int i = 0; i < 3 * count; ++i) result[i] += area * radiance[i / count] * values[i % count];
    }
  }
  return result;
}

CubeMap makeCube(int faceSize) {
  CubeMap map{faceSize, {}};
  for (std::size_t t = 0; t < cubeTexelCount(faceSize); ++t) {
    const auto wave = static_cast<float>(std::sin(1.7 * static_cast<double>(t)));
    map.radiance.emplace_back(1.0f + wave, 1.0f - wave, wave * wave);
  }
  return map;
}

TEST(ShEnvironment, Cube_AnySizeAndOrder_MatchesTheDefinition) {
  for (const auto& [faceSize, order, pieces] : {std::array{1, 6, 8}, std::array{2, 4, 4}, std::array{8, 6, 1},
                                                std::array{1, 32, 32}, std::array{4, 16, 3}}) {
    const CubeMap map = makeCube(faceSize);
    const auto expected = projectCubeByDefinition(map, order, pieces);
    const auto found = sh::projectEnvironment(map, order);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-11) << faceSize << " " << i;
  }
}

TEST(ShEnvironment, Cube_OfASky_ConvergesToTheSkyWithTheSquareOfTheTexel) {
  const Environment sky = makeSky(
      64, 32, [](const glm::dvec3& w) { return glm::vec3(1.0 + w.x, 1.0 + w.y * w.z, std::exp(w.z)); });
  const auto expected = sh::projectEnvironment(sky, 4);
  const auto worstError = [&](int faceSize) {
    const auto found = sh::projectEnvironment(cubeFromEnvironment(sky, faceSize), 4);
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, std::abs(found[i] - expected[i]));
    return worst;
  };
  const double coarse = worstError(32);
  const double fine = worstError(128);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 16.0, 2.0);
}

TEST(ShEnvironment, BadMapsAndOrders_AreErrors) {
  Environment sky = makeSky(4, 2, [](const glm::dvec3&) { return glm::vec3(1.0f); });
  EXPECT_THROW(sh::projectEnvironment(sky, 0), UsageError);
  EXPECT_THROW(sh::projectEnvironment(sky, 33), UsageError);
  EXPECT_THROW(sh::projectEnvironment(makeCube(2), 33), UsageError);
  EXPECT_THROW(sh::projectEnvironment(Environment{}, 3), InputError);
  sky.radiance[5].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(sh::projectEnvironment(sky, 3), InputError);
  sky.radiance[5].y = -1.0f;
  EXPECT_THROW(sh::projectEnvironment(sky, 3), InputError);
  CubeMap map = makeCube(2);
  map.radiance[7].z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(sh::projectEnvironment(map, 3), InputError);
  map.radiance.pop_back();
  EXPECT_THROW(sh::projectEnvironment(map, 3), InputError);
}

}  // namespace
}  // namespace prelight
