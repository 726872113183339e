#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "support/ggx_albedo.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr int shOrder = 3;
constexpr std::size_t bands = shOrder * shOrder;
constexpr std::size_t patchVertices = 9;  // Number of vertices of patch().

using Means = std::array<double, 3 * bands>;  // [channel][i].

test::BakeResult bakeSpecular(const CompiledScene& scene, std::uint64_t rays, int bounces = 0,
                              bool specular = true) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = shOrder;
  request.bounces = bounces;
  request.specular = specular;
  request.effort.rays = rays;
  return test::runBake(scene, request);
}

/// A patch too small to shadow anything, so that its transfer is that of one point.
CompiledScene patch() { return test::ground(2, 0.01f); }

CompiledMaterial glass(float ior, bool solid) {
  CompiledMaterial material;
  material.transmission = 1.0f;
  material.specular = 1.0f;
  material.roughness = 0.0f;
  material.ior = ior;
  material.solid = solid;
  material.albedo = glm::vec3(0.0f);
  material.baseColor = glm::vec3(1.0f);
  return material;
}

CompiledMaterial mirror(const glm::vec3& color) {
  CompiledMaterial material;
  material.metallic = 1.0f;
  material.roughness = 0.0f;
  material.albedo = glm::vec3(0.0f);
  material.baseColor = color;
  return material;
}

/// The patch under a sheet that hides its whole hemisphere except for 1e-4 of it.
CompiledScene underSheet(const CompiledMaterial& material) {
  CompiledScene scene = patch(), sheet = test::ground(1, 100.0f, 1.0f);
  sheet.materials[0] = material;
  test::append(scene, sheet);
  return scene;
}

/// The patch beside a wall that hides the half x < 0 of its hemisphere.
CompiledScene besideWall(const CompiledMaterial& material) {
  CompiledScene scene = patch();
  CompiledScene wall =
      test::sceneOf({{-0.02f, -0.5f, 100}, {-0.02f, -0.5f, -100}, {-0.02f, 200, -100}, {-0.02f, 200, 100}},
                    {{0, 1, 2}, {0, 2, 3}});
  wall.materials[0] = material;
  test::append(scene, wall);
  return scene;
}

Means patchMean(const Bake& baked) {
  Means mean{};
  for (std::size_t v = 0; v < patchVertices; ++v)
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += double(baked.sh->coefficients[v * mean.size() + i]) / patchVertices;
  return mean;
}

std::array<double, bands> openTransfer(const glm::dvec3& normal) {
  std::array<double, bands> open{};
  sh::openTransfer(normal, shOrder, open);
  return open;
}

/// Light that arrives under a sky of radiance 1, divided by pi.
double openness(const Means& mean, std::size_t channel) {
  return mean[channel * bands] * std::sqrt(4.0 * std::numbers::pi);
}

void expectScaled(const Means& mean, std::span<const double> open, const glm::dvec3& factor,
                  double tolerance) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < bands; ++i)
      EXPECT_NEAR(mean[static_cast<std::size_t>(c) * bands + i], factor[c] * open[i], tolerance)
          << "channel " << c << ", coefficient " << i;
}

/// Fresnel reflectance of a face for unpolarised light.
double fresnel(double cosine, double ior) {
  const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
  const double s = (cosine - ior * inside) / (cosine + ior * inside);
  const double p = (inside - ior * cosine) / (inside + ior * cosine);
  return 0.5 * (s * s + p * p);
}

TEST(SpecularTransport, PaneOfIndexOne_IsAsIfItWereNotThere) {
  const test::BakeResult result = bakeSpecular(underSheet(glass(1.0f, false)), 4096);
  ASSERT_EQ(result.bake.sh->channels, 3);
  expectScaled(patchMean(result.bake), openTransfer({0, 1, 0}), glm::dvec3(1.0), 0.004);
  double open = 0.0;
  for (std::size_t v = 0; v < patchVertices; ++v) open += double(result.bake.ao[v]) / patchVertices;
  EXPECT_NEAR(open, 0.0, 2e-3) << "AO knows no glass";
}

TEST(SpecularTransport, TintedPaneOfIndexOne_ColoursTheLight) {
  CompiledMaterial tinted = glass(1.0f, false);
  tinted.baseColor = {0.9f, 0.5f, 0.2f};
  expectScaled(patchMean(bakeSpecular(underSheet(tinted), 4096).bake), openTransfer({0, 1, 0}),
               {0.9, 0.5, 0.2}, 0.004);
}

// A slab of index 1 does not bend rays. They travel d / cos through it: 2 cos exp(-a d / cos) is integrated
// over cosines from 0 to 1, with the cosine as weight.
TEST(SpecularTransport, AbsorbingSlabOfIndexOne_FollowsBeersLaw) {
  CompiledMaterial material = glass(1.0f, true);
  material.absorption = {0.5f, 1.0f, 2.0f};
  CompiledScene scene = patch();
  CompiledScene slab = test::box(1, {-100.0f, 1.0f, -100.0f}, {100.0f, 1.4f, 100.0f}, false);
  slab.materials[0] = material;
  test::append(scene, slab);
  const Means mean = patchMean(bakeSpecular(scene, 8192).bake);
  for (int c = 0; c < 3; ++c) {
    double expected = 0.0;
    constexpr int steps = 100000;
    for (int k = 0; k < steps; ++k) {
      const double cosine = (k + 0.5) / steps;
      expected += 2.0 * cosine * std::exp(-double(material.absorption[c]) * 0.4 / cosine) / steps;
    }
    EXPECT_NEAR(openness(mean, static_cast<std::size_t>(c)), expected, 0.004) << "channel " << c;
  }
}

// Under an even sky a thin pane transmits (1 - R) / (1 + R), with R of one face, and reflects the dark ground
// beside the patch in the rest.
TEST(SpecularTransport, ThinPane_LetsThroughWhatFresnelLeaves) {
  const double ior = 1.5;
  double expected = 0.0;
  constexpr int steps = 100000;
  for (int k = 0; k < steps; ++k) {
    const double cosine = (k + 0.5) / steps, r = fresnel(cosine, ior);
    expected += 2.0 * cosine * (1.0 - r) / (1.0 + r) / steps;
  }
  CompiledScene scene = underSheet(glass(static_cast<float>(ior), false));
  CompiledScene dark = test::ground(1, 100.0f, -0.001f);
  dark.materials[0].albedo = glm::vec3(0.0f);
  test::append(scene, dark);
  EXPECT_NEAR(openness(patchMean(bakeSpecular(scene, 8192).bake), 1), expected, 0.005);
}

// An endless mirror wall beside a receiver that looks up shows the other half of the sky, reversed. Nothing
// of an even sky is missing, and a lobe along the wall's normal is seen mirrored.
TEST(SpecularTransport, MirrorWall_ShowsTheSkyBeforeIt) {
  const Means mean = patchMean(bakeSpecular(besideWall(mirror(glm::vec3(1.0f))), 8192).bake);
  EXPECT_NEAR(openness(mean, 0), 1.0, 0.004);
  // The half x < 0 of the hemisphere appears in the half x > 0. Y_1,1 is 0.4886 x, and the mean of |x| under
  // the density cos / pi is 2/3 x 2/pi.
  EXPECT_NEAR(mean[3], 0.488603 * 4.0 / (3.0 * std::numbers::pi), 0.004);
  EXPECT_NEAR(mean[1], openTransfer({0, 1, 0})[1], 0.004)
      << "Y_1,-1 is 0.4886 y, which the wall does not change";
}

// The wall is of gold. By Schlick's approximation its colour rises to 1 with the fifth power of one minus the
// cosine to the wall's normal. Rays of the receiver have the density 4 / pi sqrt(1 - x^2) in that cosine.
TEST(SpecularTransport, GoldWall_ColoursWhatItShows) {
  const glm::vec3 color(0.9f, 0.6f, 0.3f);
  double rise = 0.0;
  constexpr int steps = 100000;
  for (int k = 0; k < steps; ++k) {
    const double x = (k + 0.5) / steps;
    rise += 4.0 / std::numbers::pi * std::sqrt(1.0 - x * x) * std::pow(1.0 - x, 5.0) / steps;
  }
  const Means mean = patchMean(bakeSpecular(besideWall(mirror(color)), 8192).bake);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(openness(mean, static_cast<std::size_t>(c)), 0.5 + 0.5 * (color[c] + (1.0 - color[c]) * rise),
                0.004);
}

// A ball of glass under an even sky: all light that is not absorbed comes out again, so that a receiver sees
// sky through the ball.
TEST(SpecularTransport, GlassBallInAnEvenSky_HidesNothing) {
  CompiledScene scene = patch();
  CompiledScene ball = test::sphere(24, 0.4f, {0.0f, 0.6f, 0.0f});
  ball.materials[0] = glass(1.5f, true);
  test::append(scene, ball);
  const test::BakeResult with = bakeSpecular(scene, 8192), without = bakeSpecular(scene, 8192, 0, false);
  const double closed = std::sqrt(4.0 * std::numbers::pi) * without.bake.sh->coefficients[4 * bands];
  EXPECT_LT(closed, 0.6);
  // Rays that would return to the patch's height meet the open space below it: the whole sky is 1.
  EXPECT_NEAR(openness(patchMean(with.bake), 0), 1.0, 0.01);
}

// A pane of index 1 stands in front of a white wall, which lights the patch.
TEST(SpecularTransport, BouncesThroughAPane_AreThoseWithoutIt) {
  CompiledScene scene = patch();
  CompiledScene wall = test::sceneOf({{-2, -100, 100}, {-2, -100, -100}, {-2, 100, -100}, {-2, 100, 100}},
                                     {{0, 1, 2}, {0, 2, 3}}, 0.8f);
  test::append(scene, wall);
  const Means bare = patchMean(bakeSpecular(scene, 8192, 1).bake);
  CompiledScene pane =
      test::sceneOf({{-1, -90, 90}, {-1, -90, -90}, {-1, 90, -90}, {-1, 90, 90}}, {{0, 1, 2}, {0, 2, 3}});
  pane.materials[0] = glass(1.0f, false);
  test::append(scene, pane);
  const Means behind = patchMean(bakeSpecular(scene, 8192, 1).bake);
  for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_NEAR(behind[i], bare[i], 0.01) << i;
  EXPECT_LT(openness(patchMean(bakeSpecular(scene, 8192, 1, false).bake), 0), openness(bare, 0) - 0.2);
}

// Haar wavelets are converted from SH: their integral over the cube is that of an open hemisphere.
TEST(SpecularTransport, HaarAndCh_CarryItToo) {
  BakeRequest request;
  request.sh.order = request.ch.order = shOrder;
  request.haar.size = 8;
  request.haar.error = 0.0;
  request.specular = true;
  request.effort.rays = 4096;
  const Bake baked = test::runBake(underSheet(glass(1.0f, false)), request).bake;
  ASSERT_TRUE(baked.ch && baked.haar);
  EXPECT_EQ(baked.ch->channels, 3);
  ASSERT_EQ(baked.haar->channels, 3);
  // The first coefficients are averages of faces, scaled so that the integral over a face is the coefficient
  // times the face size.
  double integral = 0.0;
  for (std::uint32_t e = baked.haar->offsets[0]; e < baked.haar->offsets[1]; ++e)
    if (baked.haar->indices[e] % 64 == 0) integral += 8.0 * baked.haar->values[e];
  EXPECT_NEAR(integral, 1.0, 0.02);
}

TEST(SpecularTransport, TexelsOfCharts_CarryItToo) {
  const CompiledScene scene = underSheet(glass(1.0f, false));
  Chart chart{0, 0, 4, 4, {}, {}};
  for (std::size_t v = 0; v < patchVertices; ++v)
    chart.coords.emplace_back(0.5f + 50.0f * scene.positions[v].x, 0.5f + 50.0f * scene.positions[v].z);
  const Charts charts{{chart}, {}, {}};
  BakeRequest request;
  request.sh.order = shOrder;
  request.chartTransfer.size = 4;
  request.specular = true;
  request.effort.rays = 4096;
  const Bake baked = test::runBake(scene, request, charts).bake;
  ASSERT_TRUE(baked.chartTransfer);
  ASSERT_EQ(baked.chartTransfer->channels, 3);
  const std::vector<float>& texels = baked.chartTransfer->maps.at(0).coefficients;
  ASSERT_EQ(texels.size(), 4 * 4 * 3 * bands);
  Means mean{};
  for (std::size_t i = 0; i < texels.size(); ++i) mean[i % mean.size()] += double(texels[i]) / 16.0;
  expectScaled(mean, openTransfer({0, 1, 0}), glm::dvec3(1.0), 0.004);
}

TEST(SpecularTransport, WithoutMirrorsAndGlass_ChangesNoBit) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(6, 0.3f, {0.0f, 0.5f, 0.0f}));
  const test::BakeResult asked = bakeSpecular(scene, 256, 1), plain = bakeSpecular(scene, 256, 1, false);
  EXPECT_EQ(asked.bake.sh->coefficients, plain.bake.sh->coefficients);
  EXPECT_EQ(asked.report.rays, plain.report.rays);
  BakeRequest request;
  request.sh.order = shOrder;
  request.specular = true;
  const Plan plan = makePlan(Scene(), scene, request);
  EXPECT_FALSE(plan.runs(Pass::SpecularTransport));
  const auto planned = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& pass) {
    return pass.name == Pass::SpecularTransport.name;
  });
  ASSERT_NE(planned, plan.passes.end());
  EXPECT_NE(planned->reason.find("no material is transmissive"), std::string::npos) << planned->reason;
}

/// A rough dielectric, whose lobe is followed by glossy bounces only.
CompiledMaterial lacquer(float body) {
  CompiledMaterial material;
  material.specular = 1.0f;
  material.ior = 5.828427f;  // Reflects one half along the normal.
  material.roughness = 0.6f;
  material.albedo = material.baseColor = glm::vec3(body);
  return material;
}

Bake bakeUnder(const CompiledMaterial& material, int bounces, bool glossy) {
  BakeRequest request;
  request.sh.order = shOrder;
  request.bounces = bounces;
  request.specular = true;
  request.glossyBounces = glossy;
  request.effort.rays = 16384;
  return test::runBake(underSheet(material), request).bake;
}

TEST(GlossyBounces, OffBlackLacquer_BringWhatItReflectsOfTheSky) {
  double expected = 0.0;
  for (const LineSample& node : gaussLegendre(6)) {
    const double cosine = 0.5 + 0.5 * node.position;
    expected += node.weight * cosine * test::reflectedAtLast(glm::dvec3(0.5), 1.0, cosine, 0.6).x;
  }
  EXPECT_NEAR(openness(patchMean(bakeUnder(lacquer(0.0f), 0, true)), 0), expected, 0.01);
  const Bake without = bakeUnder(lacquer(0.0f), 0, false);
  for (std::size_t i = 0; i < patchVertices * bands; ++i)
    EXPECT_LT(std::abs(without.sh->coefficients[i]), 0.001f);
}

// Light that the layer reflects does not reach the body.
TEST(GlossyBounces, OffWhiteLacquerUnderAnEvenSky_LoseAndGainNoLight) {
  EXPECT_NEAR(openness(patchMean(bakeUnder(lacquer(1.0f), 1, true)), 0), 1.0, 0.01);
}

TEST(GlossyBounces, WhereNothingIsGlossy_ChangeNoBit) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(6, 0.3f, {0.0f, 0.5f, 0.0f}));
  BakeRequest request;
  request.sh.order = shOrder;
  request.bounces = 1;
  request.effort.rays = 256;
  const Bake plain = test::runBake(scene, request).bake;
  request.specular = request.glossyBounces = true;
  EXPECT_EQ(test::runBake(scene, request).bake.sh->coefficients, plain.sh->coefficients);
  const Plan plan = makePlan(Scene(), scene, request);
  const auto planned = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& pass) {
    return pass.name == Pass::SpecularTransport.name;
  });
  ASSERT_NE(planned, plan.passes.end());
  EXPECT_FALSE(planned->runs);
  EXPECT_NE(planned->reason.find("or glossy"), std::string::npos) << planned->reason;
}

TEST(SpecularTransport, SameSeed_IsTheSameBits) {
  CompiledScene scene = patch();
  CompiledScene ball = test::sphere(8, 0.4f, {0.0f, 0.6f, 0.0f});
  ball.materials[0] = glass(1.5f, true);
  test::append(scene, ball);
  EXPECT_EQ(bakeSpecular(scene, 512, 1).bake.sh->coefficients,
            bakeSpecular(scene, 512, 1).bake.sh->coefficients);
}

}  // namespace
}  // namespace prelight
