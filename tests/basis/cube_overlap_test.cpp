#include "basis/cube_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "basis/cube_map.h"

namespace prelight {
namespace {

using std::numbers::pi;

double sum(const std::vector<TexelOverlap>& overlaps) {
  double total = 0.0;
  for (const TexelOverlap& overlap : overlaps) total += overlap.solidAngle;
  return total;
}

/// Area by Girard's theorem: the sum of a spherical triangle's angles less pi.
double girard(const std::array<glm::dvec3, 3>& corners) {
  double angles = 0.0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& p = corners[i];
    const glm::dvec3 q = glm::cross(p, corners[(i + 1) % 3]), r = glm::cross(p, corners[(i + 2) % 3]);
    angles += std::atan2(glm::length(glm::cross(q, r)), glm::dot(q, r));
  }
  return angles - pi;
}

TEST(CubeOverlap, AnyTriangle_IsPartitionedByTheTexels) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (const int size : {1, 2, 8, 64}) {
    for (int i = 0; i < 30; ++i) {
      std::array<glm::dvec3, 3> corners;
      for (glm::dvec3& p : corners)
        p = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      std::vector<TexelOverlap> overlaps;
      overlapTexels(corners, size, overlaps);
      const CubeTexels texels(size);
      for (const TexelOverlap& overlap : overlaps) {
        ASSERT_GT(overlap.solidAngle, 0.0);
        ASSERT_LE(overlap.solidAngle, texels.solidAngle(overlap.texel) * (1.0 + 1e-9));
      }
      EXPECT_NEAR(sum(overlaps), girard(corners), 1e-10) << size << " " << i;
    }
  }
}

TEST(CubeOverlap, ATexelOfTheSameGrid_IsItself) {
  for (const int size : {1, 4, 16}) {
    const CubeTexels texels(size);
    for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
      std::vector<TexelOverlap> overlaps;
      overlapTexels(texelCorners(texel, size), size, overlaps);
      double own = 0.0;
      for (const TexelOverlap& overlap : overlaps) own += overlap.texel == texel ? overlap.solidAngle : 0.0;
      ASSERT_NEAR(own, texels.solidAngle(texel), 1e-13) << texel;
      ASSERT_NEAR(sum(overlaps), own, 1e-13) << texel;
    }
  }
}

TEST(CubeOverlap, TexelsOfARotatedGrid_CoverEveryTexelOnce) {
  constexpr int size = 8;
  const CubeTexels texels(size);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const glm::dmat3 turn = glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c);
  std::vector<double> covered(texels.count(), 0.0);
  for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
    auto corners = texelCorners(texel, size);
    for (glm::dvec3& corner : corners) corner = turn * corner;
    std::vector<TexelOverlap> overlaps;
    overlapTexels(corners, size, overlaps);
    EXPECT_NEAR(sum(overlaps), texels.solidAngle(texel), 1e-13);
    for (const TexelOverlap& overlap : overlaps) covered[overlap.texel] += overlap.solidAngle;
  }
  for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
    EXPECT_NEAR(covered[texel], texels.solidAngle(texel), 1e-13) << texel;
  }
}

}  // namespace
}  // namespace prelight
