#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "support/body_walk.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr int throughOrder = 3;
constexpr std::size_t throughBands = throughOrder * throughOrder;

BakeRequest throughRequest(std::uint64_t rays, int bounces) {
  BakeRequest request;
  request.sh.order = throughOrder;
  request.bounces = bounces;
  request.subsurface = true;
  request.effort.rays = rays;
  return request;
}

CompiledMaterial leaf(float albedo, float through) {
  CompiledMaterial material;
  material.albedo = glm::vec3(albedo);
  material.translucency = material.meanTranslucency = through;
  material.diffuseTransmission = glm::vec3(through);
  return material;
}

/// A material that lets all light in and out.
CompiledMaterial body(float extinction, float scattering, float anisotropy = 0.0f) {
  CompiledMaterial material = leaf(0.0f, 1.0f);
  material.solid = true;
  material.absorption = glm::vec3(extinction);
  material.scattering = glm::vec3(scattering);
  material.scatterAnisotropy = anisotropy;
  return material;
}

/// Mean over vertices, [channel][i].
std::array<double, 3 * throughBands> meanOf(const HarmonicTransfer& transfer, std::size_t first,
                                            std::size_t end) {
  std::array<double, 3 * throughBands> mean{};
  const auto channels = static_cast<std::size_t>(transfer.channels);
  for (std::size_t v = first; v < end; ++v)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < throughBands; ++i)
        mean[c * throughBands + i] +=
            double(transfer.coefficients[(v * channels + std::min(c, channels - 1)) * throughBands + i]) /
            double(end - first);
  return mean;
}

/// Light through the surface under a sky of radiance 1, divided by pi: the mean of a channel over all
/// vertices.
double throughOpenness(const HarmonicTransfer& transfer, std::size_t channel = 0) {
  const std::size_t vertices =
      transfer.coefficients.size() / (throughBands * static_cast<std::size_t>(transfer.channels));
  return meanOf(transfer, 0, vertices)[channel * throughBands] * std::sqrt(4.0 * std::numbers::pi);
}

// The transfer through a sheet in the open is an open hemisphere, turned downwards.
TEST(SubsurfaceTransport, SheetInTheOpen_KnowsItsOtherSide) {
  CompiledScene scene = test::ground(2, 1.0f);
  scene.materials[0] = leaf(0.3f, 0.5f);
  const Bake baked = test::runBake(scene, throughRequest(256, 0)).bake;
  ASSERT_TRUE(baked.through && baked.through->sh);
  std::array<double, throughBands> below{};
  sh::openTransfer({0, -1, 0}, throughOrder, below);
  const auto mean = meanOf(*baked.through->sh, 0, scene.vertexCount());
  for (std::size_t i = 0; i < throughBands; ++i) EXPECT_NEAR(mean[i], below[i], 1e-5) << i;
}

// Two endless planes: under a sky of radiance 1 the sheet's upper side sees all of it. The share t comes
// through and is reflected between the floor's f and the sheet's a: the lower side receives f t, and then f a
// times that at every second bounce.
TEST(SubsurfaceTransport, SheetAboveAFloor_IsAGeometricSeries) {
  CompiledScene scene = test::ground(8, 100.0f);
  const std::size_t floorVertices = scene.vertexCount();
  test::append(scene, test::ground(8, 100.0f, 0.2f));
  const double f = 0.6, a = 0.4, t = 0.5;
  scene.materials[0].albedo = glm::vec3(float(f));
  scene.materials[1] = leaf(float(a), float(t));
  constexpr int bounces = 8;
  const Bake baked = test::runBake(scene, throughRequest(2048, bounces)).bake;
  double expected = 0.0, term = f * t;
  for (int b = 2; b <= bounces; b += 2, term *= f * a) expected += term;
  double mean = 0.0;
  std::size_t inner = 0;
  for (std::size_t v = floorVertices; v < scene.vertexCount(); ++v) {
    if (glm::length(scene.positions[v]) > 40.0f) continue;
    mean += std::sqrt(4.0 * std::numbers::pi) * double(baked.through->sh->coefficients[v * 3 * throughBands]);
    ++inner;
  }
  EXPECT_NEAR(mean / double(inner), expected, 0.01 * expected);
  for (std::size_t i = 0; i < floorVertices * 3 * throughBands; ++i)
    ASSERT_EQ(baked.through->sh->coefficients[i], 0.0f) << "the floor lets nothing through";
}

TEST(SubsurfaceTransport, AoOfTheOtherSide_IsItsOwn) {
  CompiledScene scene = test::ground(2, 1.0f);
  test::append(scene, test::ground(1, 100.0f, -0.001f));
  scene.materials[0] = leaf(0.3f, 0.5f);
  BakeRequest request;
  request.ao = request.subsurface = true;
  request.effort.rays = 256;
  const Bake baked = test::runBake(scene, request).bake;
  ASSERT_TRUE(baked.through);
  ASSERT_EQ(baked.through->ao.size(), scene.vertexCount());
  for (std::size_t v = 0; v < 9; ++v) {
    EXPECT_NEAR(baked.ao[v], 1.0, 1e-3);
    EXPECT_NEAR(baked.through->ao[v], 0.0, 0.02);
  }
}

// CH is an exact map of the SH, and wavelets have the integral of an open hemisphere.
TEST(SubsurfaceTransport, ChAndHaar_HaveItToo) {
  CompiledScene scene = test::ground(2, 1.0f);
  scene.materials[0] = leaf(0.3f, 0.5f);
  BakeRequest request = throughRequest(256, 0);
  request.ch.order = throughOrder;
  request.haar.size = 8;
  request.haar.error = 0.0;
  const Bake baked = test::runBake(scene, request).bake;
  ASSERT_TRUE(baked.through && baked.through->ch && baked.through->haar);
  EXPECT_EQ(baked.through->ch->coefficients.size(), baked.through->sh->coefficients.size());
  const HaarTransfer& haar = *baked.through->haar;
  ASSERT_EQ(haar.channels, 3);
  double integral = 0.0;
  for (std::uint32_t e = haar.offsets[0]; e < haar.offsets[1]; ++e)
    if (haar.indices[e] % 64 == 0) integral += 8.0 * haar.values[e];
  EXPECT_NEAR(integral, 1.0, 0.01);
}

TEST(SubsurfaceTransport, WithoutTranslucentMaterials_ChangesNoBit) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(6, 0.3f, {0.0f, 0.5f, 0.0f}));
  BakeRequest request = throughRequest(256, 1);
  const test::BakeResult asked = test::runBake(scene, request);
  const Plan plan = makePlan(Scene(), scene, request);
  request.subsurface = false;
  const test::BakeResult plain = test::runBake(scene, request);
  EXPECT_EQ(asked.bake.sh->coefficients, plain.bake.sh->coefficients);
  EXPECT_EQ(asked.report.rays, plain.report.rays);
  EXPECT_FALSE(asked.bake.through);
  EXPECT_FALSE(plan.runs(Pass::SubsurfaceTransport));
  const auto planned = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& pass) {
    return pass.name == Pass::SubsurfaceTransport.name;
  });
  ASSERT_NE(planned, plan.passes.end());
  EXPECT_NE(planned->reason.find("no material lets light through"), std::string::npos) << planned->reason;
}

TEST(SubsurfaceTransport, NotAskedFor_IsNotKept) {
  CompiledScene scene = test::ground(2, 1.0f);
  scene.materials[0] = leaf(0.3f, 0.5f);
  BakeRequest request = throughRequest(256, 1);
  request.subsurface = false;
  EXPECT_FALSE(test::runBake(scene, request).bake.through);
}

// All light that enters a body that absorbs nothing comes out again, however it is scattered inside.
TEST(SubsurfaceTransport, WhiteBodyInAnEvenSky_ShowsTheSky) {
  for (const float anisotropy : {0.0f, 0.7f}) {
    CompiledScene scene = test::sphere(12, 1.0f, {0, 0, 0});
    scene.materials[0] = body(8.0f, 1.0f, anisotropy);
    const Bake baked = test::runBake(scene, throughRequest(128, 1)).bake;
    EXPECT_NEAR(throughOpenness(*baked.through->sh), 1.0, 0.004) << anisotropy;
  }
}

// Inner reflections take further bounces: half of the light that arrives leaves, and half goes on inside.
TEST(SubsurfaceTransport, WhiteBodyThatReflectsWithin_NeedsBounces) {
  CompiledScene scene = test::sphere(12, 1.0f, {0, 0, 0});
  scene.materials[0] = body(4.0f, 1.0f);
  scene.materials[0].albedo = scene.materials[0].diffuseTransmission = glm::vec3(0.5f);
  const Bake baked = test::runBake(scene, throughRequest(128, 4)).bake;
  EXPECT_NEAR(throughOpenness(*baked.through->sh), 1.0 - std::pow(0.5, 4), 0.01);
}

// A ball that only absorbs: for light that enters evenly, chords are 2 R cos long, where cos has the density
// 2 cos.
TEST(SubsurfaceTransport, AbsorbingBody_FollowsBeersLawAlongItsChords) {
  CompiledScene scene = test::sphere(24, 1.0f, {0, 0, 0});
  scene.materials[0] = body(1.0f, 0.0f);
  scene.materials[0].absorption = {0.3f, 1.0f, 2.0f};
  const Bake baked = test::runBake(scene, throughRequest(256, 1)).bake;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = 2.0 * double(scene.materials[0].absorption[static_cast<int>(c)]);
    EXPECT_NEAR(throughOpenness(*baked.through->sh, c), 2.0 * (1.0 - (1.0 + x) * std::exp(-x)) / (x * x),
                0.01)
        << c;
  }
}

// A ball that scatters and absorbs, channel by channel, compared with random walks in double within a true
// ball.
TEST(SubsurfaceTransport, ScatteringBody_ReturnsWhatWalksInDoubleDo) {
  CompiledScene scene = test::sphere(24, 1.0f, {0, 0, 0});
  scene.materials[0] = body(1.0f, 1.0f, 0.5f);
  scene.materials[0].absorption = {2.0f, 5.0f, 8.0f};
  scene.materials[0].scattering = {0.95f, 0.8f, 0.99f};
  const Bake baked = test::runBake(scene, throughRequest(256, 1)).bake;
  for (int c = 0; c < 3; ++c) {
    const double truth = test::shareThroughBall(double(scene.materials[0].absorption[c]),
                                                double(scene.materials[0].scattering[c]), 0.5, 1u << 17);
    EXPECT_NEAR(throughOpenness(*baked.through->sh, static_cast<std::size_t>(c)), truth, 0.01) << c;
  }
}

TEST(SubsurfaceTransport, SameSeed_IsTheSameBits) {
  CompiledScene scene = test::sphere(6, 1.0f, {0, 0, 0});
  scene.materials[0] = body(4.0f, 0.9f);
  EXPECT_EQ(test::runBake(scene, throughRequest(64, 2)).bake.through->sh->coefficients,
            test::runBake(scene, throughRequest(64, 2)).bake.through->sh->coefficients);
}

}  // namespace
}  // namespace prelight
