#include "basis/haar_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace prelight {
namespace {

const std::vector<glm::dvec3> ways = {{0.1, 0.2, 0.9}, {-0.6, 0.5, 0.1}, {0.3, -1.0, 0.2}, {1, 0.99, 0.98}};

/// The texels of a light that is given by its coefficients.
std::vector<double> texelsOf(const haar::SparseRow& row, int faceSize) {
  std::vector<double> values(cubeTexelCount(faceSize), 0.0);
  for (std::size_t k = 0; k < row.indices.size(); ++k) values[row.indices[k]] = row.values[k];
  haar::inverse(std::span<double>(values), faceSize);
  return values;
}

TEST(HaarDirection, Light_HasIrradianceOneAndComesFromThatDirection) {
  for (const int faceSize : {4, 16, 64}) {
    const CubeTexels texels(faceSize);
    const haar::DirectionFilter filter(faceSize);
    for (const glm::dvec3& way : ways) {
      const glm::dvec3 w = glm::normalize(way);
      const std::vector<double> light = texelsOf(filter.towards(w, w).coefficients, faceSize);
      double sum = 0.0;
      glm::dvec3 mean(0.0);
      for (std::uint32_t texel = 0; texel < light.size(); ++texel) {
        EXPECT_GE(light[texel], -1e-3);
        sum += light[texel] * texels.solidAngle(texel);
        mean += light[texel] * texels.moment(texel);
      }
      EXPECT_NEAR(sum, 1.0, 1e-5) << faceSize;
      // The filter does not cross the edges of faces, where it is off by less than a texel that it reads.
      EXPECT_GT(glm::dot(glm::normalize(mean), w), std::cos(0.5 * std::numbers::pi / std::min(faceSize, 32)))
          << faceSize;
    }
  }
}

TEST(HaarDirection, OpenReceiver_GetsTheCosineOverPi) {
  constexpr int faceSize = 32;
  const CubeTexels texels(faceSize);
  const haar::DirectionFilter filter(faceSize);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.7, 0.4));
  std::vector<float> open(texels.count());
  texels.open(normal, open);
  haar::forward(std::span<float>(open), faceSize);
  for (const glm::dvec3& way : ways) {
    const glm::dvec3 w = glm::normalize(way);
    const haar::DirectionFilter::Light light = filter.towards(w, normal);
    double seen = 0.0;
    for (std::size_t k = 0; k < light.coefficients.indices.size(); ++k)
      seen += double(light.coefficients.values[k]) * open[light.coefficients.indices[k]];
    EXPECT_NEAR(seen, light.open, 2e-3);
    EXPECT_NEAR(light.open, std::max(glm::dot(normal, w), 0.0) / std::numbers::pi, 0.02);
  }
}

}  // namespace
}  // namespace prelight
