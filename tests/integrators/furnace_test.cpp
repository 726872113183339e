#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/ggx_albedo.h"
#include "support/shot.h"

// Scenes of known radiance: every pixel must show it.
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

/// Expects the picture's mean within the error that its own variance implies.
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
  /// A room of albedo 1/2 whose walls emit 1, seen from within: its radiance is 1 / (1 - 1/2).
  Shot room() const {
    const double size = static_cast<double>(GetParam());
    Shot shot =
        shotOf(box(2, glm::vec3(-GetParam()), glm::vec3(GetParam()), true),
               cameraAt(size * glm::dvec3(0.3, 0.2, 0.1), size * glm::dvec3(-1, -0.5, -1), 1.2), 6, 256);
    shot.camera.zNear = 1e-4 * size;
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[0].emission = glm::vec3(1.0f);
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

TEST(Furnace, WhiteMirror_ShowsTheSky) { expectEverywhere(ballShot(metal(1.0f, 0.0f), 64).render(), 1.0); }

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
  // Rays at the rim run around inside until the depth ends them, but nothing is gained.
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

// A slab one metre thick with index of refraction 1 reflects nothing.
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

/// Microfacets of a body that does not refract are invisible.
TEST(Furnace, RoughGlassOfIndexOne_IsNotSeen) {
  CompiledMaterial material = glass(1.0f, true);
  material.roughness = 0.5f;
  expectEverywhere(ballShot(material, 64).render(), 1.0);
}

// Inside glass, radiance is larger by the square of the index. Beyond the critical angle the camera sees
// reflections that end outside as well.
TEST(Furnace, InsideGlass_RadianceScalesWithTheSquareOfTheIndex) {
  Shot shot = ballShot(glass(1.5f, true), 256);
  shot.camera = cameraAt({0, 0, 0}, {0, 0, -1}, 0.5);
  expectEverywhere(shot.render(), 2.25);
}

Shot metalPlate(float reflectance, float roughness, double angle) {
  const glm::dvec3 eye(std::sin(angle), std::cos(angle), 0.0);
  Shot shot = shotOf(ground(1, 1.0f), orthographicCamera(eye, {0, 0, 0}, 0.05), 16, 1024);
  shot.scene.materials[0] = metal(reflectance, roughness);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  return shot;
}

// The table of albedos (AlbedoTable) is interpolated with an error of up to 0.3 %.
TEST(Furnace, RoughMetal_ReflectsAtEveryBounce) {
  for (const float roughness : {0.1f, 0.5f, 1.0f})
    for (const double angle : {0.2, 1.2}) {
      SCOPED_TRACE(::testing::Message() << "roughness " << roughness << " angle " << angle);
      Shot shot = metalPlate(0.7f, roughness, angle);
      const double expected = reflectedAtLast(glm::dvec3(0.7), 1.0, std::cos(angle), roughness).x;
      const MeanAndError both = meanOf(shot.render());
      EXPECT_NEAR(both.mean, expected, 3e-3 * expected + 4.0 * both.error);
      shot.request.estimator = Estimator::ScatterOnly;
      const MeanAndError scattered = meanOf(shot.render());
      EXPECT_LT(scattered.error, 5e-3 * expected) << "too noisy to tell";
      EXPECT_NEAR(both.mean, scattered.mean, 4.0 * std::hypot(both.error, scattered.error));
    }
}

// Finds the light by sampling it, by drawing directions, and by both. The sky is visible through the plate as
// well.
TEST(Furnace, RoughThinGlass_ShowsTheSky) {
  for (const float roughness : {0.3f, 1.0f})
    for (const double angle : {0.2, 1.2})
      for (const Estimator estimator : {Estimator::ScatterOnly, Estimator::LightsOnly, Estimator::Both}) {
        SCOPED_TRACE(::testing::Message()
                     << "roughness " << roughness << " angle " << angle << " estimator " << int(estimator));
        Shot shot = metalPlate(0.0f, roughness, angle);
        shot.scene.materials[0] = glass(1.5f, false);
        shot.scene.materials[0].roughness = roughness;
        shot.request.estimator = estimator;
        const MeanAndError found = meanOf(shot.render());
        EXPECT_NEAR(found.mean, 1.0, 3e-3 + 4.0 * found.error);
      }
}

TEST(Furnace, RoughSolidGlass_ShowsTheSky) {
  for (const float roughness : {0.2f, 0.5f, 0.8f}) {
    SCOPED_TRACE(::testing::Message() << "roughness " << roughness);
    Shot shot = ballShot(glass(1.5f, true), 512);
    shot.scene.materials[0].roughness = roughness;
    shot.request.depth = 64;
    const MeanAndError found = meanOf(shot.render());
    EXPECT_NEAR(found.mean, 1.0, 8e-3 + 4.0 * found.error);
    EXPECT_LT(found.error, 5e-3);
  }
}

TEST(Furnace, Mirror_RisesToOneAtGrazingAngles) {
  for (const double angle : {0.0, 0.7, 1.2, 1.5}) {
    const double rise = std::pow(1.0 - std::cos(angle), 5.0);
    EXPECT_NEAR(meanOf(metalPlate(0.3f, 0.0f, angle).render()).mean, 0.3 + 0.7 * rise, 1e-5) << angle;
  }
}

}  // namespace
}  // namespace prelight::test
