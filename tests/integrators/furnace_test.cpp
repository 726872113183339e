#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shot.h"

// Scenes whose radiance is known in closed form: every pixel must show it.
namespace prelight::test {
namespace {

using reference::Estimator;
using reference::Film;
using reference::Integrator;

constexpr double tolerance = 1e-3;

void expectEverywhere(const Film& film, double expected) {
  double worst = 0.0;
  for (const glm::vec3& pixel : film.picture().pixels)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(static_cast<double>(pixel[c]) - expected));
  EXPECT_LE(worst, tolerance * expected);
}

/// The mean of the picture within what its own variance allows.
void expectMean(const Film& film, double expected) {
  const MeanAndError found = meanOf(film);
  EXPECT_LT(found.error, 5e-3 * expected) << "too noisy to tell";
  EXPECT_LT(std::abs(found.mean - expected), 4.0 * found.error + 1e-5 * expected)
      << found.mean << " for " << expected;
}

CompiledScene flat(CompiledScene scene) {
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  return scene;
}

/// A ball that fills the picture.
Shot ballShot(const CompiledMaterial& material, std::uint64_t samples) {
  Shot shot =
      shotOf(flat(sphere(12, 1.0f, {0, 0, 0})), orthographicCamera({0, 0, 5}, {0, 0, 0}, 0.6), 6, samples);
  shot.scene.materials[0] = material;
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.depth = 200;
  return shot;
}

class ClosedRoom : public ::testing::TestWithParam<float> {
 protected:
  /// A room of albedo 1/2 whose walls emit 1: radiance 1 / (1 - 1/2), seen from within.
  Shot room() const {
    const double size = static_cast<double>(GetParam());
    Shot shot =
        shotOf(box(2, glm::vec3(-GetParam()), glm::vec3(GetParam()), true),
               cameraAt(size * glm::dvec3(0.3, 0.2, 0.1), size * glm::dvec3(-1, -0.5, -1), 1.2), 6, 256);
    shot.camera.zNear = 1e-4 * size;
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[0].emissionFactor = glm::vec3(1.0f);
    shot.request.depth = 64;
    return shot;
  }
};

TEST_P(ClosedRoom, FollowedPaths_SumTheGeometricSeries) {
  Shot shot = room();
  shot.request.estimator = Estimator::ScatterOnly;
  shot.request.rouletteDepth = shot.request.depth;
  expectEverywhere(shot.render(), 2.0);
  // Roulette adds noise, but no bias.
  shot.request.rouletteDepth = 2;
  shot.request.samples = 2048;
  expectMean(shot.render(), 2.0);
}

TEST_P(ClosedRoom, SampledLights_HaveTheSameMean) { expectMean(room().render(), 2.0); }

INSTANTIATE_TEST_SUITE_P(Sizes, ClosedRoom, ::testing::Values(1e-3f, 1.0f, 1e4f));

TEST(Furnace, Depth_CutsTheSeries) {
  Shot shot = ballShot(lambert(0.5f), 64);
  shot.request.estimator = Estimator::ScatterOnly;
  shot.request.depth = 1;
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
  shot.request.depth = 2;
  expectEverywhere(shot.render(), 0.5);
}

TEST(Furnace, LambertBall_ShowsItsAlbedo) {
  Shot shot = ballShot(lambert(0.5f), 64);
  shot.request.estimator = Estimator::ScatterOnly;
  expectEverywhere(shot.render(), 0.5);
  shot = ballShot(lambert(0.5f), 1024);
  expectMean(shot.render(), 0.5);
  shot.request.estimator = Estimator::LightsOnly;
  expectMean(shot.render(), 0.5);
}

TEST(Furnace, Mirror_ShowsItsReflectance) { expectEverywhere(ballShot(metal(0.8f, 0.0f), 64).render(), 0.8); }

TEST(Furnace, Glass_ShowsTheSky) {
  for (const float ior : {1.0f, 1.5f, 1.8f, 0.0f})
    for (const bool solid : {true, false}) {
      SCOPED_TRACE(::testing::Message() << "ior " << ior << (solid ? " solid" : " thin"));
      expectEverywhere(ballShot(glass(ior, solid), 64).render(), 1.0);
    }
}

TEST(Furnace, GlassWithSmoothNormals_ShowsTheSky) {
  Shot shot = shotOf(sphere(24, 1.0f, {0, 0, 0}), orthographicCamera({0, 0, 5}, {0, 0, 0}, 0.6), 12, 32);
  shot.scene.materials[0] = glass(1.5f, true);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.depth = 400;
  expectEverywhere(shot.render(), 1.0);
  // At the rim rays run round within until the depth ends them, but nothing is gained.
  shot.camera = orthographicCamera({0, 0, 5}, {0, 0, 0}, 1.1);
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_LE(pixel.r, 1.0f + tolerance);
}

TEST(Furnace, TintedThinGlass_IsTintedOnceASurface) {
  Shot shot = shotOf(ground(1, 1.0f), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.1), 4, 4096);
  shot.scene.materials[0] = glass(1.5f, false);
  shot.scene.materials[0].baseColor = glm::vec3(0.5f);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  const double once = std::pow(0.5 / 2.5, 2.0), all = 2.0 * once / (1.0 + once);
  expectMean(shot.render(), all + 0.5 * (1.0 - all));
}

// A slab one metre thick, index of refraction 1: nothing is reflected.
TEST(Furnace, AbsorbingGlass_FollowsBeersLaw) {
  Shot shot = shotOf(flat(box(1, {-1, 0, -1}, {1, 1, 1}, false)),
                     orthographicCamera({0, 2, 0}, {0, 0, 0}, 0.1), 4, 32);
  shot.scene.materials[0] = glass(1.0f, true);
  shot.scene.materials[0].absorption = {0.5f, 1.0f, 2.0f};
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  for (const glm::vec3& pixel : shot.render().picture().pixels)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(pixel[c], std::exp(-static_cast<double>(shot.scene.materials[0].absorption[c])), 1e-4);
}

// A camera inside glass: radiance is larger there by the square of the index (and what is beyond the critical
// angle is seen by way of reflections that end outside as well).
TEST(Furnace, InsideGlass_RadianceScalesWithTheSquareOfTheIndex) {
  Shot shot = ballShot(glass(1.5f, true), 256);
  shot.camera = cameraAt({0, 0, 0}, {0, 0, -1}, 0.5);
  expectEverywhere(shot.render(), 2.25);
}

/// Share of light along `cosine` that a GGX surface without Fresnel loss reflects once: quadrature over the
/// half vector of D G2 / (4 cos cos) cos, in double precision.
double ggxAlbedo(double cosine, double roughness) {
  const double a = roughness * roughness, a2 = a * a;
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (c * c) - 1.0)) - 1.0); };
  constexpr int steps = 1000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    // tan(theta) = a sqrt(x / (1 - x)) makes D constant in x.
    const double x = (i + 0.5) / steps;
    const double tangent2 = a2 * x / (1.0 - x), c = 1.0 / std::sqrt(1.0 + tangent2),
                 s = std::sqrt(1.0 - c * c);
    for (int j = 0; j < steps; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / steps;
      const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), c);
      const double oh = glm::dot(wo, h);
      const double ci = 2.0 * oh * h.z - wo.z;
      if (oh <= 0.0 || ci <= 0.0) continue;
      // D cos(h) dh = dx dphi / (2 pi); dwi = 4 (wo.h) dh.
      sum += oh / (c * cosine) / (1.0 + lambda(cosine) + lambda(ci));
    }
  }
  return sum / (static_cast<double>(steps) * steps);
}

TEST(Furnace, RoughMetal_LosesWhatSingleScatteringLoses) {
  for (const float roughness : {0.1f, 0.5f, 1.0f})
    for (const double angle : {0.2, 1.2}) {
      SCOPED_TRACE(::testing::Message() << "roughness " << roughness << " angle " << angle);
      const glm::dvec3 eye(std::sin(angle), std::cos(angle), 0.0);
      Shot shot = shotOf(ground(1, 1.0f), orthographicCamera(eye, {0, 0, 0}, 0.05), 16, 1024);
      shot.scene.materials[0] = metal(0.9f, roughness);
      shot.sky = constantEnvironment(glm::vec3(1.0f));
      shot.request.estimator = Estimator::ScatterOnly;
      const MeanAndError found = meanOf(shot.render());
      const double expected = 0.9 * ggxAlbedo(std::cos(angle), roughness);
      EXPECT_NEAR(found.mean, expected, 1e-3 * expected);
      shot.request.estimator = Estimator::Both;
      expectMean(shot.render(), expected);
    }
}

}  // namespace
}  // namespace prelight::test
