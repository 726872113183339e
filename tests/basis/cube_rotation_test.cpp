#include "basis/cube_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/lab/wavelet_trials.h"

namespace prelight {
namespace {

glm::dmat3 turnY(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

glm::dmat3 turnX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{1.0, 0.0, 0.0}, {0.0, c, s}, {0.0, -s, c}};
}

template <typename F>
CubeMap sample(int faceSize, F f) {
  CubeMap map = darkCube(faceSize);
  for (std::uint32_t i = 0; i < map.radiance.size(); ++i) {
    map.radiance[i] = glm::vec3(static_cast<float>(f(cubeTexelDirection(i, faceSize))));
  }
  return map;
}

double redFlux(const CubeMap& map) {
  const CubeTexels texels(map.faceSize);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < texels.count(); ++i) sum += texels.solidAngle(i) * map.radiance[i].x;
  return sum;
}

double smooth(const glm::dvec3& w) { return 2.0 + w.x + 0.5 * w.y * w.z; }

double greatestError(const CubeResampling& resampling, const glm::dmat3& rotation) {
  const CubeMap rotated = resampling.apply(sample(resampling.faceSize, smooth));
  double greatest = 0.0;
  for (std::uint32_t i = 0; i < rotated.radiance.size(); ++i) {
    const double expected = smooth(glm::transpose(rotation) * cubeTexelDirection(i, resampling.faceSize));
    greatest = std::max(greatest, std::abs(rotated.radiance[i].x - expected));
  }
  return greatest;
}

TEST(CubeRotation, ByNoAngleAndByQuarters_MovesTexelsWhole) {
  constexpr int size = 8;
  const CubeMap map =
      sample(size, [](const glm::dvec3& w) { return 3.0 + std::sin(7.0 * w.x + 3.0 * w.y) + w.z; });
  for (int quarter = 0; quarter < 4; ++quarter) {
    const glm::dmat3 rotation =
        turnY(0.5 * std::numbers::pi * quarter) * turnX(0.5 * std::numbers::pi * quarter);
    const CubeMap rotated = rotateByArea(rotation, size).apply(map);
    for (std::uint32_t i = 0; i < map.radiance.size(); ++i) {
      const std::uint32_t source = cubeTexel(glm::transpose(rotation) * cubeTexelDirection(i, size), size);
      ASSERT_NEAR(rotated.radiance[i].x, map.radiance[source].x, 1e-5) << quarter << " " << i;
    }
  }
}

TEST(CubeRotation, ByArea_OfAConstant_IsTheConstant) {
  const CubeResampling resampling = rotateByArea(turnX(0.3) * turnY(1.1), 16);
  for (const glm::vec3& texel :
       resampling.apply(sample(16, [](const glm::dvec3&) { return 2.5; })).radiance) {
    ASSERT_NEAR(texel.x, 2.5, 1e-5);
  }
}

TEST(CubeRotation, ByArea_KeepsTheFluxOfASmallSunAndByPointDoesNot) {
  constexpr int size = 64;
  CubeMap sun = darkCube(size);
  addDisk(sun, glm::normalize(glm::dvec3(0.5, 0.7, 0.3)), 0.01, glm::vec3(1000.0f));
  double worstPoint = 0.0;
  for (const double angle : {0.1, 0.5, 1.0, 2.0}) {
    const glm::dmat3 rotation = turnY(angle) * turnX(0.4);
    EXPECT_NEAR(redFlux(rotateByArea(rotation, size).apply(sun)) / redFlux(sun), 1.0, 1e-6) << angle;
    worstPoint = std::max(worstPoint,
                          std::abs(redFlux(rotateByPoint(rotation, size).apply(sun)) / redFlux(sun) - 1.0));
  }
  EXPECT_GT(worstPoint, 0.02);
}

TEST(CubeRotation, OfASmoothFunction_ConvergesToTheRotatedFunction) {
  const glm::dmat3 rotation = turnY(0.8) * turnX(0.4);
  const double coarse = greatestError(rotateByArea(rotation, 8), rotation);
  const double fine = greatestError(rotateByArea(rotation, 32), rotation);
  EXPECT_LT(coarse, 0.1);
  EXPECT_LT(fine, coarse / 3.0);
  EXPECT_LT(greatestError(rotateByPoint(rotation, 32), rotation), 0.1);
}

TEST(CubeRotation, OfALightAtADirection_TurnsItThere) {
  constexpr int size = 32;
  CubeMap sun = darkCube(size);
  addDisk(sun, {1.0, 0.0, 0.0}, 0.05, glm::vec3(1.0f));
  const glm::dmat3 rotation = turnY(0.6);
  const CubeMap rotated = rotateByArea(rotation, size).apply(sun);
  const CubeTexels texels(size);
  glm::dvec3 moment(0.0);
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    moment += texels.moment(i) * double(rotated.radiance[i].x);
  EXPECT_LT(glm::distance(glm::normalize(moment), rotation * glm::dvec3(1.0, 0.0, 0.0)), 2e-3);
}

}  // namespace
}  // namespace prelight
