// Pictures of measured materials with transfer matrices, compared with the integral of the tabulated model.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "basis/sh_evaluate.h"
#include "scene/measured_brdf.h"
#include "support/merl_files.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"
#include "viewer/techniques/glossy/measured_lobes.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

glm::dvec3 model(const glm::dvec3& wo, const glm::dvec3& wi) {
  return ggxBrdf({0.6, 0.4, 0.2}, 0.5)(wo, wi) + glm::dvec3(0.1, 0.2, 0.3) / std::numbers::pi;
}

Material measured() {
  static const auto brdf = std::make_shared<const MeasuredBrdf>(tabulated(model));
  Material material;
  setMeasured(brdf, material);
  return material;
}

/// A sky that is nowhere dark, so that a few bands of it are nowhere negative.
Environment paleHalvedSky() {
  Environment sky = halvedSky();
  for (glm::vec3& radiance : sky.radiance) radiance += 1.0f;
  return sky;
}

/// Radiance of an open surface along wo under light of an order, in world coordinates.
glm::dvec3 exitRadiance(const std::vector<double>& light, int order, const glm::dmat3& frame,
                        const glm::dvec3& wo) {
  const std::size_t count = light.size() / 3;
  glm::dvec3 sum(0.0);
  for (const SphereSample& sample : sphereQuadrature(199)) {
    if (sample.direction.z <= 0.0) continue;
    const glm::dvec3 value = model(wo, sample.direction) * (sample.direction.z * sample.weight);
    for (int c = 0; c < 3; ++c) {
      const std::span channel(light.data() + static_cast<std::size_t>(c) * count, count);
      sum[c] += value[c] * sh::reconstruct(channel, order, frame * sample.direction);
    }
  }
  return sum;
}

TEST(MeasuredShading, OpenSurface_ShowsTheIntegralOfBrdfCosineAndLight) {
  for (const int order : {1, 3, 4, 6}) {
    QuadScene quad;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 0.4, 0.2)));
    quad.add(measured(), 1.0f, turned);
    const glm::dmat3 frame(turned);
    const glm::dvec3 wo = glm::normalize(glm::dvec3(0.5, 0.3, 0.9));
    quad.lookFrom(frame * (2.0 * wo), {0, 0, 0});
    quad.setSky(paleHalvedSky());
    quad.compile();
    quad.bake.glossy = openMatrices(quad.compiled.normals, order, 1);
    const std::vector<double> light = sh::projectEnvironment(quad.environment, order);
    const glm::dvec3 expected = exitRadiance(light, order, frame, wo);
    ASSERT_GT(expected.r, 0.05);
    expectColor(pixelAt(quad.render(square(Shading::Glossy, 129))), expected, 6e-3);
  }
}

TEST(MeasuredShading, AlongTheNormal_ShowsTheSameFromAllSides) {
  QuadScene quad;
  quad.add(measured());
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(paleHalvedSky());
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 3);
  const std::vector<double> light = sh::projectEnvironment(quad.environment, 4);
  expectColor(pixelAt(quad.render(square(Shading::Glossy, 129))),
              exitRadiance(light, 4, glm::dmat3(1.0), glm::dvec3(0, 0, 1)), 6e-3);
}

/// A lamp comes through the matrices as a delta function, cut to their bands.
TEST(MeasuredShading, Lamp_IsReflectedOnce) {
  constexpr int order = 6;
  const glm::dvec3 toLamp = glm::normalize(glm::dvec3(-0.4, -0.2, 0.9));
  QuadScene quad;
  quad.add(measured());
  const glm::dvec3 wo = glm::normalize(glm::dvec3(0.5, 0.3, 0.9));
  quad.lookFrom(2.0 * wo, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Directional, {3, 2, 1}, {0, 0, 0}, -toLamp)};
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, order, 1);
  std::vector<double> basis(order * order), light;
  sh::evaluate(toLamp, order, basis);
  for (const double irradiance : {3.0, 2.0, 1.0})
    for (const double value : basis) light.push_back(irradiance * value);
  expectColor(pixelAt(quad.render(square(Shading::Glossy, 129))),
              exitRadiance(light, order, glm::dmat3(1.0), wo), 0.03);
}

TEST(MeasuredShading, OfLambert_IsTheDiffuseSurface) {
  const glm::dvec3 albedo(0.8, 0.5, 0.25);
  const auto brdf = std::make_shared<const MeasuredBrdf>(
      tabulated([&](const auto&, const auto&) { return albedo / std::numbers::pi; }));
  Picture pictures[2];
  for (const bool table : {false, true}) {
    Material material = lambertian(brdf->diffuse);
    if (table) setMeasured(brdf, material);
    QuadScene quad;
    quad.add(material);
    quad.lookFrom({0.5, 0.2, 2}, {0, 0, 0});
    quad.setSky(paleHalvedSky());
    quad.compile();
    quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 1);
    pictures[table ? 1 : 0] = quad.render(square(Shading::Glossy));
  }
  EXPECT_EQ(largestDifference(pictures[0], pictures[1]), 0.0);
}

}  // namespace
}  // namespace prelight
