#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh.h"
#include "cast/caster.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr int order = 3;
constexpr std::size_t n = order * order;

Bake bake(const CompiledScene& scene, int bounces, std::uint64_t rays) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = order;
  request.bounces = bounces;
  request.effort.rays = rays;
  BakeReport report;
  Progress progress;
  return bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report);
}

/// A patch too small to shadow anything, under a sheet that hides its whole hemisphere but for 1e-4 of it.
CompiledScene patchUnderSheet(bool facingDown) {
  CompiledScene scene = test::ground(2, 0.01f);
  CompiledScene sheet = test::ground(1, 100.0f, 1.0f);
  if (facingDown)
    for (glm::uvec3& t : sheet.triangles) std::swap(t.y, t.z);
  test::append(scene, sheet);
  scene.materials[0].albedo = glm::vec3(0.0f);
  scene.materials[1].albedo = {0.3f, 0.1f, 0.5f};
  scene.materials[1].diffuseTransmission = {0.1f, 0.5f, 0.2f};
  return scene;
}

/// Mean over the patch's vertices, [channel][i].
std::array<double, 3 * n> patchMean(const Bake& result) {
  std::array<double, 3 * n> mean{};
  for (std::size_t v = 0; v < 9; ++v)
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += result.sh->coefficients[v * mean.size() + i] / 9.0;
  return mean;
}

class TranslucentSheet : public ::testing::TestWithParam<bool> {};

// Both sides of the sheet are open. The patch sees albedo x the open transfer of the lower side plus
// transmission x that of the upper side, whichever side is the front.
TEST_P(TranslucentSheet, UnderOpenSky_SendsBothSides) {
  const CompiledScene scene = patchUnderSheet(GetParam());
  const auto mean = patchMean(bake(scene, 1, 16384));
  std::array<double, n> below{}, above{};
  sh::openTransfer({0, -1, 0}, order, below);
  sh::openTransfer({0, 1, 0}, order, above);
  const glm::vec3 albedo = scene.materials[1].albedo, through = scene.materials[1].diffuseTransmission;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(mean[static_cast<std::size_t>(c) * n + i], albedo[c] * below[i] + through[c] * above[i],
                  0.004)
          << "channel " << c << ", coefficient " << i;
}

// Light that came through once is reflected by the floor, and then comes through or is reflected again. Two
// endless parallel planes under a sky of radiance 1: if X leaves the floor and S leaves the sheet downwards,
// S = t + a X and X = f S.
TEST_P(TranslucentSheet, AboveAFloor_IsAGeometricSeries) {
  CompiledScene scene = test::ground(8, 100.0f);
  CompiledScene sheet = test::ground(8, 100.0f, 0.2f);
  if (GetParam())
    for (glm::uvec3& t : sheet.triangles) std::swap(t.y, t.z);
  test::append(scene, sheet);
  const double f = 0.6, a = 0.4, t = 0.5;
  scene.materials[0].albedo = glm::vec3(float(f));
  scene.materials[1].albedo = glm::vec3(float(a));
  scene.materials[1].diffuseTransmission = glm::vec3(float(t));
  constexpr int bounces = 8;
  const Bake result = bake(scene, bounces, 2048);
  // Light on the floor after B bounces: even counts end at the sheet. The sheet adds t, and then f a for
  // every further two.
  double expected = 0.0, term = t;
  for (int b = 1; b <= bounces; b += 2, term *= f * a) expected += term;
  double mean = 0.0;
  std::size_t inner = 0;
  for (std::size_t v = 0; v < 81; ++v) {
    if (glm::length(scene.positions[v]) > 40.0f) continue;
    mean += std::sqrt(4.0 * std::numbers::pi) * double(result.sh->coefficients[v * 3 * n]);
    ++inner;
  }
  EXPECT_NEAR(mean / double(inner), expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(FrontUpAndDown, TranslucentSheet, ::testing::Bool());

// A receiver within a closed one-sided lampshade sees light through the shade's backs, so the place is not
// inside an object.
TEST(Translucent, Backs_AreNotTheInsideOfAnObject) {
  CompiledScene scene = test::sphere(4, 1.0f, {0, 0, 0});
  EXPECT_EQ(twoSidedTriangles(scene).front(), 0);
  scene.materials[0].diffuseTransmission = glm::vec3(0.1f);
  EXPECT_EQ(twoSidedTriangles(scene).front(), 1);
}

TEST(Translucent, Plan_SaysWhyItIsSkipped) {
  BakeRequest request;
  request.sh.order = 2;
  request.bounces = 1;
  const CompiledScene scene = patchUnderSheet(false);
  EXPECT_TRUE(makePlan(Scene(), scene, request).runs(Pass::TranslucentSenders));
  EXPECT_FALSE(makePlan(Scene(), test::ground(2, 1.0f), request).runs(Pass::TranslucentSenders));
  request.bounces = 0;
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::TranslucentSenders));
  CompiledScene black = scene;
  black.materials[1].albedo = glm::vec3(0.0f);
  request.bounces = 1;
  EXPECT_TRUE(makePlan(Scene(), black, request).runs(Pass::Bounces))
      << "what transmits sends, be its albedo 0";
}

}  // namespace
}  // namespace prelight
