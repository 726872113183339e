#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "basis/ch.h"
#include "basis/quadrature.h"
#include "basis/sh.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A ground with a ball above it and a wall beside it, for shadows and reflections.
CompiledScene ballAndWall() {
  CompiledScene scene = test::ground(8, 1.0f);
  test::append(scene, test::sphere(8, 0.3f, {0.0f, 0.5f, 0.0f}));
  test::append(scene, test::box(3, {-1.2f, 0.0f, -1.0f}, {-1.0f, 1.0f, 1.0f}, false));
  for (auto& material : scene.materials) material.albedo = {0.8f, 0.5f, 0.2f};
  return scene;
}

std::span<const float> rowOf(const HarmonicTransfer& transfer, std::size_t vertex, std::size_t channel) {
  const auto n = static_cast<std::size_t>(transfer.order * transfer.order);
  return std::span(transfer.coefficients)
      .subspan((vertex * static_cast<std::size_t>(transfer.channels) + channel) * n, n);
}

// Both sums are evaluated by definition in random directions, without a map between the bases.
TEST(HarmonicBake, ChOfTheSameCast_ReconstructsWhatShDoes) {
  const CompiledScene scene = ballAndWall();
  std::mt19937 random(1);
  for (const int order : {1, 3, 6, 14}) {
    BakeRequest request;
    request.sh.order = request.ch.order = order;
    request.bounces = 1;
    request.effort.rays = 64;
    const Bake bake = test::runBake(scene, request).bake;
    ASSERT_EQ(bake.ch->channels, 3);
    const auto n = static_cast<std::size_t>(order * order);
    std::vector<double> y(n), c(n);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
      const glm::dvec3 w = glm::normalize(glm::dvec3(test::randomDirection(random)));
      sh::evaluate(w, order, y);
      ch::evaluate(w, order, c);
      const std::size_t vertex = random() % scene.vertexCount(), channel = random() % 3;
      const auto a = rowOf(*bake.sh, vertex, channel), b = rowOf(*bake.ch, vertex, channel);
      double fromSh = 0.0, fromCh = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        fromSh += double(a[i]) * y[i];
        fromCh += double(b[i]) * c[i];
      }
      worst = std::max(worst, std::abs(fromSh - fromCh));
    }
    EXPECT_LT(worst, 1e-6) << "order " << order;
  }
}

TEST(HarmonicBake, ChNaive_StoresInnerProducts) {
  BakeRequest request;
  request.sh.order = request.ch.order = 4;
  request.ch.naive = true;
  request.effort.rays = 64;
  const Bake bake = test::runBake(test::ground(2, 1.0f), request).bake;
  EXPECT_TRUE(bake.ch->naive);
  // <T, C_i> by quadrature of the band-limited transfer.
  std::vector<double> y(16), c(16), expected(16, 0.0);
  const auto sh = rowOf(*bake.sh, 0, 0);
  for (const SphereSample& s : sphereQuadrature(6)) {
    sh::evaluate(s.direction, 4, y);
    ch::evaluate(s.direction, 4, c);
    double value = 0.0;
    for (std::size_t i = 0; i < 16; ++i) value += sh[i] * y[i];
    for (std::size_t i = 0; i < 16; ++i) expected[i] += s.weight * value * c[i];
  }
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(rowOf(*bake.ch, 0, 0)[i], expected[i], 1e-6);
}

TEST(HarmonicBake, SmallerOrderBesideALarger_IsItsFirstBands) {
  const CompiledScene scene = ballAndWall();
  BakeRequest both;
  both.sh.order = 2;
  both.ch.order = 5;
  both.effort.rays = 64;
  BakeRequest alone = both;
  alone.ch.order = 0;
  alone.sh.order = 5;
  const Bake two = test::runBake(scene, both).bake, five = test::runBake(scene, alone).bake;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rowOf(*two.sh, v, 0)[i], rowOf(*five.sh, v, 0)[i]);
}

TEST(HarmonicBake, Order32OpenPlane_IsTheClosedForm) {
  BakeRequest request;
  request.sh.order = 32;
  request.effort.rays = 16;
  const Bake bake = test::runBake(test::ground(2, 1.0f), request).bake;
  std::vector<double> expected(1024);
  sh::openTransfer({0.0, 1.0, 0.0}, 32, expected);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(rowOf(*bake.sh, 0, 0)[i], expected[i], 1e-6);
}

double entry(const GlossyTransfer& glossy, std::size_t vertex, std::size_t channel, std::size_t i,
             std::size_t j) {
  const auto n = static_cast<std::size_t>(glossy.order * glossy.order);
  return glossy.matrices[((vertex * static_cast<std::size_t>(glossy.channels) + channel) * n + i) * n + j];
}

TEST(GlossyBake, OpenPlane_IsTheIntegralOfCosineTimesTwoHarmonics) {
  BakeRequest request;
  request.glossy.order = 4;
  request.effort.rays = 16;
  const Bake bake = test::runBake(test::ground(2, 1.0f), request).bake;
  ASSERT_EQ(bake.glossy->channels, 1);
  std::vector<double> expected(256, 0.0), y(16);
  // The cosine has a kink at the horizon: midpoints of half a million cells leave an error of 1e-6.
  const int rows = 500, columns = 1000;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double cosine = (r + 0.5) / rows, turn = 2.0 * std::numbers::pi * (c + 0.5) / columns;
      const double sine = std::sqrt(1.0 - cosine * cosine);
      sh::evaluate({sine * std::cos(turn), cosine, sine * std::sin(turn)}, 4, y);
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j)
          expected[16 * i + j] += 2.0 * cosine * y[i] * y[j] / (rows * columns);
    }
  for (std::size_t i = 0; i < 256; ++i) EXPECT_NEAR(bake.glossy->matrices[i], expected[i], 2e-5) << i;
}

// Y_0 is constant, so its row is the diffuse transfer, whatever occludes and however often light bounces.
TEST(GlossyBake, FirstRow_IsTheDiffuseTransferWithItsBounces) {
  const CompiledScene scene = ballAndWall();
  BakeRequest request;
  request.sh.order = request.glossy.order = 3;
  request.bounces = 2;
  request.effort.rays = 256;
  const Bake bake = test::runBake(scene, request).bake;
  ASSERT_EQ(bake.glossy->channels, 3);
  for (std::size_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < 9; ++j)
        EXPECT_NEAR(entry(*bake.glossy, v, c, 0, j) * std::sqrt(4.0 * std::numbers::pi),
                    rowOf(*bake.sh, v, c)[j], 3e-5);
}

// Light of a bounce arrives in Y_i of the directions that it comes from.
TEST(GlossyBake, Bounce_ArrivesFromTheSidesItComesFrom) {
  // A tiny ground is far below a huge white ceiling, which is lit from below by the sky: all light arrives
  // after one bounce.
  CompiledScene scene = test::ground(2, 0.05f);
  test::append(scene, test::box(2, {-40.0f, 1.0f, -40.0f}, {40.0f, 1.1f, 40.0f}, false));
  BakeRequest request;
  request.sh.order = request.glossy.order = 2;
  request.bounces = 1;
  request.effort.rays = 4096;
  const Bake bake = test::runBake(scene, request).bake;
  // The ceiling's underside sees almost nothing but the empty space around the ground: the open lower half of
  // the sky.
  std::vector<double> underside(4), y(4), expected(16, 0.0);
  sh::openTransfer({0.0, -1.0, 0.0}, 2, underside);
  const int rows = 300, columns = 600;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double cosine = (r + 0.5) / rows, turn = 2.0 * std::numbers::pi * (c + 0.5) / columns;
      const double sine = std::sqrt(1.0 - cosine * cosine);
      sh::evaluate({sine * std::cos(turn), cosine, sine * std::sin(turn)}, 2, y);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          expected[4 * i + j] += 2.0 * cosine * y[i] * underside[j] / (rows * columns);
    }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(entry(*bake.glossy, 4, 0, i, j), expected[4 * i + j], 0.004) << i << ", " << j;
}

}  // namespace
}  // namespace prelight
