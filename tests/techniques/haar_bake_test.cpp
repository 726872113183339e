#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "basis/cube_map.h"
#include "basis/haar.h"
#include "basis/sh.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Texels of a vertex's row, uncompressed.
std::vector<double> texelsOf(const HaarTransfer& haar, std::size_t vertex, std::size_t channel = 0) {
  std::vector<double> texels(cubeTexelCount(haar.faceSize), 0.0);
  const std::size_t row = vertex * static_cast<std::size_t>(haar.channels) + channel;
  for (std::uint32_t i = haar.offsets[row]; i < haar.offsets[row + 1]; ++i)
    texels[haar.indices[i]] = haar.values[i];
  haar::inverse(std::span(texels), haar.faceSize);
  return texels;
}

BakeRequest haarRequest(int faceSize, double error, std::uint64_t rays) {
  BakeRequest request;
  request.haar.size = faceSize;
  request.haar.error = error;
  request.effort.rays = rays;
  return request;
}

CompiledScene groundUnderBall() {
  CompiledScene scene = test::ground(10, 1.0f);
  test::append(scene, test::sphere(12, 0.35f, {0.1f, 0.6f, 0.0f}));
  return scene;
}

TEST(HaarBake, OpenPlane_IsTheClosedForm) {
  const Bake bake = test::runBake(test::ground(3, 1.0f), haarRequest(16, 0.0, 64)).bake;
  std::vector<double> open(cubeTexelCount(16));
  CubeTexels(16).open({0.0, 1.0, 0.0}, std::span(open));
  const std::vector<double> texels = texelsOf(*bake.haar, 5);
  for (std::size_t t = 0; t < open.size(); ++t) EXPECT_NEAR(texels[t], open[t], 1e-8) << t;
}

TEST(HaarBake, Rows_AreSparseAscendingAndOfEveryVertex) {
  const CompiledScene scene = groundUnderBall();
  const Bake bake = test::runBake(scene, haarRequest(32, 0.02, 256)).bake;
  const HaarTransfer& haar = *bake.haar;
  ASSERT_EQ(haar.offsets.size(), scene.vertexCount() + 1);
  for (std::size_t row = 0; row + 1 < haar.offsets.size(); ++row) {
    ASSERT_LE(haar.offsets[row], haar.offsets[row + 1]);
    for (std::uint32_t i = haar.offsets[row]; i < haar.offsets[row + 1]; ++i) {
      EXPECT_LT(haar.indices[i], cubeTexelCount(32));
      EXPECT_TRUE(std::isfinite(haar.values[i]));
      EXPECT_TRUE(i == haar.offsets[row] || haar.indices[i] > haar.indices[i - 1]);
    }
  }
  EXPECT_LT(haar.indices.size(), cubeTexelCount(32) * scene.vertexCount() / 4);
}

// The device sorts directions into texels; the host computes which they should be.
TEST(HaarBake, HalfSpaceBlocked_IsDarkOnThatSideAlone) {
  // The ground is beside a very high wall at x = -1, which blocks directions to -x, and more of them the
  // nearer it is.
  CompiledScene scene = test::ground(6, 1.0f);
  test::append(scene, test::box(1, {-1.2f, -200.0f, -200.0f}, {-1.0001f, 200.0f, 200.0f}, false));
  const Bake bake = test::runBake(scene, haarRequest(16, 0.0, 1024)).bake;
  const std::size_t middle = 24;  // Middle vertex of 7 x 7.
  ASSERT_EQ(scene.positions[middle], glm::vec3(0.0f));
  const std::vector<double> texels = texelsOf(*bake.haar, middle);
  std::vector<double> open(texels.size());
  CubeTexels(16).open({0.0, 1.0, 0.0}, std::span(open));
  for (std::uint32_t t = 0; t < texels.size(); ++t) {
    const glm::dvec3 w = cubeTexelDirection(t, 16);
    if (std::abs(w.x) < 0.1) continue;
    EXPECT_NEAR(texels[t], w.x < 0.0 ? 0.0 : open[t], 1e-7) << t;
  }
}

TEST(HaarBake, SumOfTexels_IsTheAccessibility) {
  const CompiledScene scene = groundUnderBall();
  BakeRequest request = haarRequest(32, 0.0, 1024);
  request.ao = true;
  const Bake bake = test::runBake(scene, request).bake;
  double squares = 0.0;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const std::vector<double> texels = texelsOf(*bake.haar, v);
    const double sum = std::accumulate(texels.begin(), texels.end(), 0.0);
    squares += (sum - bake.ao[v]) * (sum - bake.ao[v]);
  }
  EXPECT_LT(std::sqrt(squares / scene.vertexCount()), 0.008);
}

// The two projections share rays, but no mathematics. Wavelets are fitted through local rows of the inverse,
// which costs about 2 % on a mesh as coarse as this.
TEST(HaarBake, ProjectedToSh_AgreesWithTheShBake) {
  const CompiledScene scene = groundUnderBall();
  BakeRequest request = haarRequest(32, 0.0, 1024);
  request.sh.order = 4;
  request.bounces = 1;
  const Bake bake = test::runBake(scene, request).bake;
  ASSERT_EQ(bake.haar->channels, 3);
  const CubeTexels cube(32);
  std::vector<std::vector<double>> basis(cube.count(), std::vector<double>(16));
  for (std::uint32_t t = 0; t < cube.count(); ++t) sh::evaluate(cubeTexelDirection(t, 32), 4, basis[t]);
  double error = 0.0, norm = 0.0;
  for (std::size_t v = 0; v < scene.vertexCount(); v += 3) {
    const std::vector<double> texels = texelsOf(*bake.haar, v, 1);
    for (std::size_t i = 0; i < 16; ++i) {
      double fromTexels = 0.0;
      for (std::size_t t = 0; t < texels.size(); ++t) fromTexels += texels[t] * basis[t][i];
      const double expected = bake.sh->coefficients[(3 * v + 1) * 16 + i];
      error += (fromTexels - expected) * (fromTexels - expected);
      norm += expected * expected;
    }
  }
  EXPECT_LT(std::sqrt(error / norm), 0.03);
}

TEST(HaarBake, StatedError_BoundsWhatLeavingOutCosts) {
  const CompiledScene scene = groundUnderBall();
  const Bake whole = test::runBake(scene, haarRequest(32, 0.0, 256)).bake;
  std::size_t before = whole.haar->indices.size();
  for (const double error : {0.005, 0.02, 0.1}) {
    const Bake sparse = test::runBake(scene, haarRequest(32, error, 256)).bake;
    EXPECT_LT(sparse.haar->indices.size(), before);
    before = sparse.haar->indices.size();
    for (std::size_t v = 0; v < scene.vertexCount(); v += 7) {
      const std::vector<double> a = texelsOf(*whole.haar, v), b = texelsOf(*sparse.haar, v);
      double lost = 0.0, norm = 0.0;
      for (std::size_t t = 0; t < a.size(); ++t) {
        lost += (a[t] - b[t]) * (a[t] - b[t]);
        norm += a[t] * a[t];
      }
      EXPECT_LE(std::sqrt(lost), 1.0001 * error * std::sqrt(norm) + 1e-9) << "vertex " << v;
    }
  }
}

// Face sizes agree on all common levels of detail, except for detail below a texel.
TEST(HaarBake, FaceSizes_AgreeOnTheirCommonTexels) {
  const CompiledScene scene = groundUnderBall();
  const Bake fine = test::runBake(scene, haarRequest(32, 0.0, 1024)).bake;
  const Bake coarse = test::runBake(scene, haarRequest(4, 0.0, 1024)).bake;
  double error = 0.0, norm = 0.0;
  for (std::size_t v = 0; v < scene.vertexCount(); v += 5) {
    const std::vector<double> a = texelsOf(*fine.haar, v), b = texelsOf(*coarse.haar, v);
    std::vector<double> sums(b.size(), 0.0);
    for (std::size_t t = 0; t < a.size(); ++t) sums[t / 32 / 8 * 4 + t % 32 / 8] += a[t];
    for (std::size_t t = 0; t < b.size(); ++t) {
      error += (sums[t] - b[t]) * (sums[t] - b[t]);
      norm += b[t] * b[t];
    }
  }
  EXPECT_LT(std::sqrt(error / norm), 0.02);
}

// Rays that are left out for lack of memory are a fair sample of all rays.
TEST(HaarBake, LittleMemoryForRays_LeavesTheMeanAsItIs) {
  const CompiledScene scene = groundUnderBall();
  BakeRequest request = haarRequest(8, 0.0, 1024);
  request.ao = true;
  request.maxMemory = 2u << 20;
  const Bake bake = test::runBake(scene, request).bake;
  double sum = 0.0, squares = 0.0;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const std::vector<double> texels = texelsOf(*bake.haar, v);
    const double difference = std::accumulate(texels.begin(), texels.end(), 0.0) - bake.ao[v];
    sum += difference;
    squares += difference * difference;
  }
  const double count = scene.vertexCount(), rms = std::sqrt(squares / count);
  EXPECT_GT(rms, 0.008) << "nothing was left out";
  EXPECT_LT(rms, 0.1);
  EXPECT_LT(std::abs(sum / count), 4.0 * rms / std::sqrt(count) + 0.002);
}

}  // namespace
}  // namespace prelight
