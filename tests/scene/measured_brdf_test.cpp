// Measured BRDFs against the analytic models from which they were tabulated.
#include "scene/measured_brdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scene/codecs/merl_brdf.h"
#include "scene/lobes.h"
#include "support/ggx_albedo.h"
#include "support/merl_files.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

glm::dvec3 randomDirection(std::mt19937& random, double least) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double z = least + (1.0 - least) * unit(random), turn = 2.0 * pi * unit(random),
               r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

TEST(MeasuredBrdf, OfLambert_IsDiffuseAndNothingElse) {
  const glm::dvec3 albedo(0.8, 0.5, 0.25);
  const MeasuredBrdf brdf = tabulated([&](const auto&, const auto&) { return albedo / pi; });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(brdf.diffuse[c]), albedo[c], 1e-6);
  EXPECT_TRUE(brdf.rest.empty());
  const CompiledMaterial material = measuredMaterial(std::make_shared<const MeasuredBrdf>(brdf));
  EXPECT_FALSE(reflectsSpecularly(material));
  EXPECT_FALSE(hasMeasuredLobe(material));
  EXPECT_EQ(material.albedo, brdf.diffuse);
}

// Values are linear between the centres of cells. A cell of the difference angle is a degree wide; within it
// GGX rises as much as its cosines shrink, by a quarter at 4 degrees above the surface.
TEST(MeasuredBrdf, OfGgxOverLambert_IsTheModel) {
  const Brdf ggx = ggxBrdf(glm::dvec3(0.5, 0.3, 0.2), 0.3);
  const glm::dvec3 body(0.1, 0.2, 0.3);
  const Brdf model = [&](const glm::dvec3& wo, const glm::dvec3& wi) { return ggx(wo, wi) + body / pi; };
  const MeasuredBrdf brdf = tabulated(model);
  std::mt19937 random(5);
  double sum = 0.0;
  constexpr int count = 5000;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 wo = randomDirection(random, 0.12), wi = randomDirection(random, 0.12);
    const glm::dvec3 got = brdfAt(brdf.rest, wo, wi) + glm::dvec3(brdf.diffuse) / pi,
                     expected = model(wo, wi);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 0.02 * expected[c]) << wo.z << " " << wi.z;
    sum += std::abs(got.x / expected.x - 1.0);
  }
  EXPECT_LT(sum / count, 0.001);
  // A lobe vanishes far from its centre, so that the constant part is the body.
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(double(brdf.diffuse[c]), body[c]);
    EXPECT_LT(double(brdf.diffuse[c]), body[c] + 0.01);
  }
}

TEST(MeasuredBrdf, Albedos_AreThoseOfTheModel) {
  const MeasuredBrdf brdf = tabulated(ggxBrdf(glm::dvec3(0.7), 0.5));
  for (const double cosine : {1.0, 0.7, 0.4, 0.2}) {
    const glm::dvec2 once = reflectedOnce(cosine, 0.5);
    const double got = albedoAt(brdf.albedos, cosine).x + double(brdf.diffuse.x);
    EXPECT_NEAR(got, 0.7 * (once.x + once.y), 0.004) << cosine;
  }
}

TEST(MeasuredBrdf, LobeToSampleBy_IsAboutAsWideAsTheModel) {
  for (const double roughness : {0.2, 0.5}) {
    const MeasuredBrdf brdf = tabulated(ggxBrdf(glm::dvec3(0.7), roughness));
    EXPECT_NEAR(double(brdf.roughness), roughness, 0.25 * roughness);
    EXPECT_LT(brdf.cosineShare, 0.3f);
  }
}

TEST(MeasuredBrdf, ThatReflectsMoreThanArrives_IsScaledAndStaysReciprocal) {
  Warnings warnings;
  const Brdf bright = [](const glm::dvec3& wo, const glm::dvec3& wi) {
    return glm::dvec3(0.4 / (wo.z * wi.z + 0.05), 0.1, 0.1);
  };
  const MeasuredBrdf brdf = makeMeasuredBrdf(parseMerlBrdf(merlFile(bright), "bright"), "bright", warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], testing::HasSubstr("times the light that arrives"));
  for (const glm::vec3& albedo : brdf.albedos) EXPECT_LE(albedo.x + brdf.diffuse.x, 1.001f);
  EXPECT_NEAR(double(brdf.diffuse.y), 0.1 * pi, 1e-5);
  std::mt19937 random(6);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 wo = randomDirection(random, 0.0), wi = randomDirection(random, 0.0);
    EXPECT_NEAR(brdfAt(brdf.rest, wo, wi).x, brdfAt(brdf.rest, wi, wo).x, 1e-6);
  }
}

TEST(MeasuredBrdf, WhatWasNotMeasured_TakesItsNeighboursValue) {
  std::vector<glm::vec3> values =
      parseMerlBrdf(merlFile([](const auto&, const auto&) { return glm::dvec3(0.1); }), "x");
  for (int j = 20; j < 60; ++j)
    for (int k = 0; k < 180; ++k)
      values[static_cast<std::size_t>((12 * 90 + j) * 180 + k)] = glm::vec3(-1.0f);
  for (std::size_t i = 0; i < std::size_t{90} * 180; ++i)
    values[std::size_t{5} * 90 * 180 + i] = glm::vec3(-1.0f);
  Warnings warnings;
  const MeasuredBrdf brdf = makeMeasuredBrdf(values, "x", warnings);
  EXPECT_TRUE(brdf.rest.empty());
  EXPECT_NEAR(double(brdf.diffuse.x), 0.1 * pi, 1e-6);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], testing::HasSubstr("were not measured"));
}

TEST(MeasuredBrdf, WhereNothingWasMeasured_IsRefused) {
  Warnings warnings;
  EXPECT_THROW(makeMeasuredBrdf(std::vector<glm::vec3>(MeasuredBrdf::cells, glm::vec3(-1.0f)), "x", warnings),
               InputError);
}

}  // namespace
}  // namespace prelight::test
