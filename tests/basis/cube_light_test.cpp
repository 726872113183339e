#include "basis/cube_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180.0;

const std::vector<glm::dvec3> directions = {{0.0, 0.0, 1.0},
                                            glm::normalize(glm::dvec3(1.0, 1.0, 1.0)),
                                            glm::normalize(glm::dvec3(0.3, 0.9, -0.2)),
                                            glm::normalize(glm::dvec3(-1.0, 0.0, 1.0))};

/// Irradiance of an open surface, divided by pi.
glm::dvec3 openLight(const CubeMap& map, const glm::dvec3& normal) {
  const CubeTexels texels(map.faceSize);
  std::vector<double> open(texels.count());
  texels.open(normal, std::span<double>(open));
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < open.size(); ++i) sum += open[i] * glm::dvec3(map.radiance[i]);
  return sum;
}

TEST(CubeLight, Disk_OfAnySize_HasItsFluxAndItsRadiance) {
  for (const int size : {1, 8, 64}) {
    const CubeTexels texels(size);
    for (const double halfAngle : {0.25 * degree, 1.5 * degree, 20.0 * degree, 80.0 * degree}) {
      for (const glm::dvec3& direction : directions) {
        CubeMap map = darkCube(size);
        addDisk(map, direction, halfAngle, glm::vec3(100.0f, 10.0f, 0.0f));
        double flux = 0.0;
        for (std::uint32_t i = 0; i < texels.count(); ++i) {
          flux += texels.solidAngle(i) * map.radiance[i].x;
          ASSERT_LE(map.radiance[i].x, 100.001f);
          ASSERT_NEAR(map.radiance[i].y, 0.1f * map.radiance[i].x, 1e-5f);
          const glm::dvec3 w = cubeTexelDirection(i, size);
          const double apart = std::atan2(glm::length(glm::cross(w, direction)), glm::dot(w, direction));
          const double reach = 1.5 / size;  // More than half of a texel's diagonal.
          if (apart < halfAngle - reach) {
            ASSERT_NEAR(map.radiance[i].x, 100.0f, 1e-3f);
          }
          if (apart > halfAngle + reach) {
            ASSERT_EQ(map.radiance[i].x, 0.0f);
          }
        }
        EXPECT_NEAR(flux / (200.0 * pi * (1.0 - std::cos(halfAngle))), 1.0, 1e-5) << size << " " << halfAngle;
      }
    }
  }
}

TEST(CubeLight, Directional_LightsOpenSurfacesByItsCosine) {
  for (const glm::dvec3& direction : directions) {
    CubeMap map = darkCube(64);
    addDirectional(map, direction, glm::vec3(3.0f));
    for (const glm::dvec3& normal : directions) {
      const double expected = 3.0 * glm::dot(normal, direction) / pi;
      if (expected > 0.2) {
        EXPECT_NEAR(openLight(map, normal).x / expected, 1.0, 5e-3);
      }
      if (expected < -0.2) {
        EXPECT_EQ(openLight(map, normal).x, 0.0);
      }
    }
  }
}

TEST(CubeLight, Directional_ThatMovesAlittle_ChangesTexelsAlittle) {
  CubeMap before = darkCube(64);
  addDirectional(before, {1.0, 0.0, 0.0}, glm::vec3(1.0f));
  CubeMap after = darkCube(64);
  addDirectional(after, glm::normalize(glm::dvec3(1.0, 1e-5, 0.0)), glm::vec3(1.0f));
  float greatest = 0.0f, change = 0.0f;
  for (std::size_t i = 0; i < before.radiance.size(); ++i) {
    greatest = std::max(greatest, before.radiance[i].x);
    change = std::max(change, std::abs(after.radiance[i].x - before.radiance[i].x));
  }
  EXPECT_GT(change, 0.0f);
  EXPECT_LT(change, 1e-3f * greatest);
}

TEST(CubeLight, Cubes_AddTexelByTexel) {
  CubeMap map = darkCube(2), other = map;
  for (std::size_t i = 0; i < map.radiance.size(); ++i) {
    map.radiance[i] = glm::vec3(1.0f, 2.0f, static_cast<float>(i));
    other.radiance[i] = glm::vec3(static_cast<float>(i), 0.5f, 4.0f);
  }
  addCube(map, other);
  for (std::size_t i = 0; i < map.radiance.size(); ++i) {
    const auto n = static_cast<float>(i);
    EXPECT_EQ(map.radiance[i], glm::vec3(1.0f + n, 2.5f, n + 4.0f)) << i;
  }
}

TEST(CubeLight, BadLights_AreRefused) {
  CubeMap map = darkCube(4);
  for (const double angle : {0.0, -1.0, 0.5 * pi, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(addDisk(map, {0, 0, 1}, angle, glm::vec3(1.0f)), UsageError) << angle;
  }
  for (const float bad : {-1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_THROW(addDisk(map, {0, 0, 1}, 0.1, glm::vec3(1.0f, bad, 1.0f)), InputError);
    EXPECT_THROW(addDirectional(map, {0, 0, 1}, glm::vec3(1.0f, bad, 1.0f)), InputError);
  }
  EXPECT_THROW(addCube(map, darkCube(8)), UsageError);
  EXPECT_THROW(darkCube(5), UsageError);
}

}  // namespace
}  // namespace prelight
