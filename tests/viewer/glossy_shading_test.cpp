// Pictures of glossy surfaces with transfer matrices, compared with closed forms and with SH.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "images/sky_lamps.h"
#include "support/disk_skies.h"
#include "support/ggx_albedo.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

Material glossyMaterial(float roughness, float metallic) {
  Material material;
  material.baseColor = {0.8f, 0.6f, 0.4f, 1.0f};
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

TEST(GlossyShading, OpenSurfaceInAWhiteFurnace_ShowsItsReflectanceAndTheAlbedoBelowIt) {
  for (const int order : {1, 2, 4, 6, 8}) {
    for (const float roughness : {0.0f, 0.3f, 0.71f, 1.0f}) {
      for (const float metallic : {0.0f, 1.0f}) {
        QuadScene quad;
        quad.add(glossyMaterial(roughness, metallic));
        const glm::dvec3 eye(0.9, 0.5, 1.8);
        quad.lookFrom(eye, {0, 0, 0});
        quad.setSky(constantEnvironment(glm::vec3(2)));
        quad.compile();
        quad.bake.glossy = openMatrices(quad.compiled.normals, order, 1);
        const glm::dvec3 base(0.8, 0.6, 0.4);
        const glm::dvec3 f0 = metallic > 0.0f ? base : glm::dvec3(0.04);
        const glm::dvec3 albedo = metallic > 0.0f ? glm::dvec3(0.0) : base;
        const glm::dvec3 reflected =
            reflectedAtLast(f0, 1.0, eye.z / glm::length(eye), std::max(roughness, 0.01f));
        const glm::dvec3 expected = 2.0 * (albedo * (1.0 - reflected) + reflected);
        // Rows and columns of pixels are off the centre by up to a pixel of 33, which changes the view angle
        // noticeably.
        expectColor(pixelAt(quad.render(square(Shading::Glossy, 129))), expected, 3e-3);
        if (order > 2) continue;
        quad.bakeOpen(order);
        expectColor(pixelAt(quad.render(square(Shading::Sh, 129))), expected, 3e-3);
      }
    }
  }
}

TEST(GlossyShading, DiffusePart_IsWhatShOfTheSameOrderShows) {
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(false);
    quad.bake.glossy = openMatrices(quad.compiled.normals, 4, channels);
    quad.bakeOpen(4, channels);
    const Picture sh = quad.render(square(Shading::Sh));
    EXPECT_LT(largestDifference(quad.render(square(Shading::Glossy)), sh), 1e-5 * largest(sh));
  }
}

/// Sum over the whole sphere in `steps` by 2 steps equal parts of z and azimuth.
template <typename Function>
double integrate(int steps, const Function& f) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double z = (2.0 * i + 1.0) / steps - 1.0;
    const double radius = std::sqrt(1.0 - z * z);
    for (int k = 0; k < 2 * steps; ++k) {
      const double phi = pi * (k + 0.5) / steps;
      sum += f(glm::dvec3(radius * std::cos(phi), radius * std::sin(phi), z));
    }
  }
  return sum * 4.0 * pi / (2.0 * steps * steps);
}

/// GGX with height-correlated masking, seen and lit under the same angle to the normal: the half vector is
/// the normal. Without what bounces between microfacets, which a roughness of 0.3 adds little of.
TEST(GlossyShading, Lamp_HasTheExactLobeTimesTheShareThatArrives) {
  constexpr double alpha = 0.09, cosine = 0.8, sine = 0.6;
  QuadScene quad;
  quad.add(glossyMaterial(0.3f, 1.0f));
  quad.lookFrom({2.0 * sine, 0.0, 2.0 * cosine}, {0, 0, 0});
  quad.compile();
  viewer::RenderOptions options = square(Shading::Glossy, 257);
  options.lights =
      std::vector<Light>{makeLight(LightType::Directional, glm::vec3(2.0f), {}, {sine, 0.0, -cosine})};
  const double masking =
      0.5 / (2.0 * cosine * std::sqrt(cosine * cosine * (1.0 - alpha * alpha) + alpha * alpha));
  const double brdf = masking / (pi * alpha * alpha);
  const double rise = std::pow(1.0 - cosine, 5.0);
  const glm::dvec3 reflectance = glm::dvec3(0.8, 0.6, 0.4) * (1.0 - rise) + rise;
  for (const double share : {1.0, 0.5}) {
    quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 1);
    for (float& m : quad.bake.glossy->matrices) m *= static_cast<float>(share);
    const glm::dvec3 expected = share * 2.0 * cosine * brdf * reflectance;
    const glm::dvec3 found(pixelAt(quad.render(options)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.02 * expected[c]) << share;
  }
}

/// A lobe that the matrices hold whole, so that it shows nothing of the sky's map.
TEST(GlossyShading, LampOfASky_IsReflectedAsALightOfItsIrradiance) {
  constexpr double cosine = 0.8, sine = 0.6;
  QuadScene quad;
  quad.add(glossyMaterial(0.9f, 1.0f));
  quad.lookFrom({2.0 * sine, 0.0, 2.0 * cosine}, {0, 0, 0});
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 1);
  for (float& m : quad.bake.glossy->matrices) m *= 0.5f;
  viewer::RenderOptions options = square(Shading::Glossy);
  const Environment sky = test::skyWithDisk(1024, glm::vec3(0.0f), {-sine, 0.0, cosine}, 0.01,
                                            glm::vec3(static_cast<float>(2.0 / (pi * 0.01 * 0.01))));
  const LampsAndSky parts = takeLampsOut(sky);
  ASSERT_EQ(parts.lamps.size(), 1u);
  const SkyLamp& lamp = parts.lamps[0];
  options.lights =
      std::vector<Light>{makeLight(LightType::Directional, glm::vec3(lamp.irradiance), {}, -lamp.direction)};
  const glm::vec3 expected = pixelAt(quad.render(options));
  options.lights.reset();
  quad.setSky(sky);
  const glm::vec3 found = pixelAt(quad.render(options));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.02f * expected[c]);
}

TEST(GlossyShading, PhongLobeInTheOpen_IsTheIntegralOfLobeCosineAndShLight) {
  constexpr int order = 6;
  constexpr int count = order * order;
  constexpr float roughness = 0.75f;  // A step of the table.
  QuadScene quad;
  quad.add(glossyMaterial(roughness, 1.0f));
  const glm::dvec3 eye(0.8, 0.3, 1.7);
  quad.lookFrom(eye, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, order, 3);
  viewer::RenderOptions options = square(Shading::Glossy, 129);
  options.lobe = viewer::Lobe::Phong;
  const glm::vec3 pixel = pixelAt(quad.render(options));

  const double exponent = 2.0 / std::pow(roughness, 4) - 2.0;
  const glm::dvec3 mirrored = glm::normalize(glm::dvec3(-eye.x, -eye.y, eye.z));
  const auto lobe = [&](const glm::dvec3& w) {
    return (exponent + 2.0) / (2.0 * pi) * std::pow(std::max(glm::dot(w, mirrored), 0.0), exponent);
  };
  std::vector<double> basis(count);
  std::vector<double> lobeCoefficients(count, 0.0);
  for (int i = 0; i < count; ++i) {
    lobeCoefficients[i] = integrate(200, [&](const glm::dvec3& w) {
      sh::evaluate(w, order, basis);
      return lobe(w) * basis[i];
    });
  }
  const std::vector<double> light = sh::projectEnvironment(quad.environment, order);
  const glm::dvec3 f0(0.8f, 0.6f, 0.4f);
  glm::dvec3 expected(0.0);
  for (int c = 0; c < 3; ++c) {
    expected[c] = f0[c] * integrate(200, [&](const glm::dvec3& w) {
                    sh::evaluate(w, order, basis);
                    double f = 0.0;
                    double l = 0.0;
                    for (int i = 0; i < count; ++i) {
                      f += lobeCoefficients[i] * basis[i];
                      l += light[c * count + i] * basis[i];
                    }
                    return std::max(w.z, 0.0) * f * l;
                  });
  }
  ASSERT_GT(expected.r + expected.g, 0.1);
  expectColor(pixel, expected, 4e-3);
}

TEST(GlossyShading, PhongLobeAlongTheNormalOfAnEvenSky_ReflectsItsF0) {
  QuadScene quad;
  quad.add(glossyMaterial(0.75f, 1.0f));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(1)));
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, 8, 1);
  viewer::RenderOptions options = square(Shading::Glossy);
  options.lobe = viewer::Lobe::Phong;
  expectColor(pixelAt(quad.render(options)), {0.8, 0.6, 0.4}, 1e-3);
}

}  // namespace
}  // namespace prelight
