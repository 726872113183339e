#include "basis/cube_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "basis/quadrature.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;

std::vector<glm::dvec3> randomDirections(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) {
    directions.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  }
  return directions;
}

/// Integral of f(w) over a texel by a product rule on sub-squares, without closed forms.
template <typename F>
auto integrateTexel(std::uint32_t texel, int faceSize, int parts, F f) {
  const int face = static_cast<int>(texel) / (faceSize * faceSize);
  const int row = static_cast<int>(texel) / faceSize % faceSize, column = static_cast<int>(texel) % faceSize;
  const auto nodes = gaussLegendre(6);
  decltype(f(glm::dvec3())) sum(0.0);
  for (int part = 0; part < parts * parts; ++part) {
    for (const LineSample& down : nodes) {
      for (const LineSample& across : nodes) {
        const double u = (column + (part % parts + 0.5 + 0.5 * across.position) / parts) / faceSize;
        const double v = (row + (part / parts + 0.5 + 0.5 * down.position) / parts) / faceSize;
        const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
        const double area = across.weight * down.weight / (double(parts) * parts * faceSize * faceSize);
        sum += area * std::pow(1.0 + a * a + b * b, -1.5) * f(cubeDirection(face, u, v));
      }
    }
  }
  return sum;
}

TEST(CubeMap, Direction_OfEachFace_IsOpenGls) {
  const auto expectDirection = [](int face, double u, double v, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(cubeDirection(face, u, v), glm::normalize(expected)), 1e-15) << face;
  };
  // OpenGL 4.6, table 8.19: sc, tc and the major axis of each face.
  expectDirection(0, 0.75, 0.9, {1.0, -0.8, -0.5});
  expectDirection(1, 0.75, 0.9, {-1.0, -0.8, 0.5});
  expectDirection(2, 0.75, 0.9, {0.5, 1.0, 0.8});
  expectDirection(3, 0.75, 0.9, {0.5, -1.0, -0.8});
  expectDirection(4, 0.75, 0.9, {0.5, -0.8, 1.0});
  expectDirection(5, 0.75, 0.9, {-0.5, -0.8, -1.0});
}

TEST(CubeMap, Texel_OfItsOwnCentre_IsItself) {
  for (const int size : {1, 2, 16, 64}) {
    for (std::uint32_t texel = 0; texel < cubeTexelCount(size); ++texel) {
      ASSERT_EQ(cubeTexel(3.0 * cubeTexelDirection(texel, size), size), texel);
    }
  }
}

TEST(CubeMap, SolidAngles_EverySize_AddUpToTheSphere) {
  for (int size = 1; size <= maxCubeFaceSize; size *= 4) {
    const CubeTexels texels(size);
    double sum = 0.0;
    for (std::uint32_t texel = 0; texel < texels.count(); ++texel) sum += texels.solidAngle(texel);
    EXPECT_NEAR(sum, 4.0 * pi, 1e-9) << size;
  }
}

TEST(CubeMap, SolidAngleAndMoment_OfTexels_AreTheirIntegrals) {
  for (const int size : {1, 4, 32}) {
    const CubeTexels texels(size);
    for (std::uint32_t texel = 0; texel < texels.count();
         texel += 1 + static_cast<std::uint32_t>(size * size / 5)) {
      const double solidAngle = integrateTexel(texel, size, 32 / size, [](const glm::dvec3&) { return 1.0; });
      const glm::dvec3 moment = integrateTexel(texel, size, 32 / size, [](const glm::dvec3& w) { return w; });
      EXPECT_NEAR(texels.solidAngle(texel), solidAngle, 1e-11 * solidAngle) << size << " " << texel;
      EXPECT_LT(glm::distance(texels.moment(texel), moment), 1e-11 * solidAngle) << size << " " << texel;
    }
  }
}

TEST(CubeMap, Open_AnyNormal_AddsUpToOne) {
  for (const int size : {1, 2, 8, 64, 256}) {
    const CubeTexels texels(size);
    std::vector<double> values(texels.count());
    std::vector<float> floats(texels.count());
    std::vector<glm::dvec3> normals = randomDirections(20);
    normals.insert(normals.end(), {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}});
    normals.push_back(glm::normalize(glm::dvec3(1, 1, 0)));
    for (const glm::dvec3& normal : normals) {
      texels.open(normal, std::span<double>(values));
      texels.open(normal, std::span<float>(floats));
      double sum = 0.0, floatSum = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_GE(values[i], 0.0);
        sum += values[i];
        floatSum += floats[i];
      }
      EXPECT_NEAR(sum, 1.0, 1e-10) << size;
      EXPECT_NEAR(floatSum, 1.0, 1e-6) << size;
    }
  }
}

TEST(CubeMap, Open_TexelsAcrossTheHorizon_AreTheIntegralOfTheClampedCosine) {
  constexpr int size = 4;
  const CubeTexels texels(size);
  std::vector<double> values(texels.count());
  for (const glm::dvec3& normal : randomDirections(3)) {
    texels.open(normal, std::span<double>(values));
    for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
      const double integral = integrateTexel(
          texel, size, 16, [&](const glm::dvec3& w) { return std::max(glm::dot(normal, w), 0.0) / pi; });
      EXPECT_NEAR(values[texel], integral, 3e-6) << texel;  // The quadrature rule does not resolve the kink.
    }
  }
}

Environment sky(int width, int height) {
  return {width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width) * height, glm::vec3(0.0f))};
}

double rowSolidAngle(int row, int height) {
  return 2.0 * pi * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
}

glm::dvec3 flux(const CubeMap& map) {
  const CubeTexels texels(map.faceSize);
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    sum += texels.solidAngle(i) * glm::dvec3(map.radiance[i]);
  return sum;
}

TEST(CubeFromEnvironment, ConstantSky_IsConstant) {
  for (const int size : {1, 2, 8, 32}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 32}}) {
      Environment even = sky(width, height);
      for (glm::vec3& texel : even.radiance) texel = {1.0f, 2.0f, 0.25f};
      for (const glm::vec3& texel : cubeFromEnvironment(even, size).radiance) {
        ASSERT_NEAR(texel.x, 1.0, 1e-6) << size << " " << width;
        ASSERT_NEAR(texel.y, 2.0, 2e-6);
        ASSERT_NEAR(texel.z, 0.25, 1e-6);
      }
    }
  }
}

TEST(CubeFromEnvironment, OneBrightTexelAnywhere_KeepsItsFlux) {
  for (const int size : {1, 2, 16, 64}) {
    for (const auto& [row, column] : {std::pair{0, 5}, {3, 17}, {11, 30}, {16, 0}, {24, 63}, {31, 40}}) {
      Environment dark = sky(64, 32);
      dark.radiance[static_cast<std::size_t>(row) * 64 + column] = glm::vec3(1e4f, 1.0f, 0.0f);
      const double expected = 1e4 * rowSolidAngle(row, 32) / 64.0;
      const glm::dvec3 sum = flux(cubeFromEnvironment(dark, size));
      EXPECT_NEAR(sum.x / expected, 1.0, 1e-6) << size << " " << row << " " << column;
      EXPECT_NEAR(sum.y / expected, 1e-4, 1e-10);
      EXPECT_EQ(sum.z, 0.0);
    }
  }
}

TEST(CubeFromEnvironment, FineNoise_MeansOverTexelsMatchBruteForce) {
  Environment noise = sky(90, 47);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform;
  for (glm::vec3& texel : noise.radiance) texel = glm::vec3(uniform(random));
  constexpr int size = 4;
  const CubeMap map = cubeFromEnvironment(noise, size);
  const CubeTexels texels(size);
  for (std::uint32_t texel = 0; texel < texels.count(); texel += 11) {
    const double integral = integrateTexel(texel, size, 250, [&](const glm::dvec3& w) {
      const glm::dvec2 uv = Environment::coordinates(w);
      const int column = std::min(static_cast<int>(uv.x * 90), 89),
                row = std::min(static_cast<int>(uv.y * 47), 46);
      return static_cast<double>(noise.radiance[static_cast<std::size_t>(row) * 90 + column].x);
    });
    EXPECT_NEAR(map.radiance[texel].x, integral / texels.solidAngle(texel), 3e-4) << texel;
  }
}

TEST(CubeMap, BadSizes_AreRefusedWithWhatIsExpected) {
  for (const int size : {0, -4, 3, 48, 2048}) {
    try {
      checkCubeFaceSize(size, "--haar");
      FAIL() << size;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("--haar"));
      EXPECT_THAT(error.what(), testing::HasSubstr("got faces of " + std::to_string(size) + " texels"));
      EXPECT_THAT(error.what(), testing::HasSubstr("power of two from 1 to 1024"));
    }
    EXPECT_THROW(CubeTexels{size}, UsageError);
    EXPECT_THROW(cubeFromEnvironment(constantEnvironment(glm::vec3(1.0f)), size), UsageError);
  }
}

TEST(CubeMap, BadRadiance_IsRefusedWithItsPlace) {
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    CubeMap map{2, std::vector<glm::vec3>(24, glm::vec3(1.0f))};
    EXPECT_NO_THROW(checkCubeMap(map, "map"));
    map.radiance[4 * 3 + 2].y = bad;
    try {
      checkCubeMap(map, "map");
      FAIL() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("face 3, row 1, column 0, channel 1"));
    }
    Environment environment = sky(4, 2);
    environment.radiance[5].z = bad;
    try {
      cubeFromEnvironment(environment, 2);
      FAIL() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("row 1, column 1, channel 2"));
    }
  }
  EXPECT_THROW(checkCubeMap({2, std::vector<glm::vec3>(23)}, "map"), InputError);
}

}  // namespace
}  // namespace prelight
