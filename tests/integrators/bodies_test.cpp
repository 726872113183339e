#include <gtest/gtest.h>

#include <cmath>

#include "support/body_walk.h"
#include "support/shot.h"

// Pictures of bodies that scatter light inside (KHR_materials_volume_scatter), against closed forms and
// random walks in double.
namespace prelight::test {
namespace {

/// A surface that lets all light in and out diffusely.
CompiledMaterial bodyOf(const glm::vec3& extinction, const glm::vec3& scattering, float anisotropy) {
  CompiledMaterial m = translucent(1.0f, 1.0f, 1.0f);
  m.specular = 0.0f;
  m.roughness = 1.0f;
  m.solid = true;
  m.absorption = extinction;
  m.scattering = scattering;
  m.scatterAnisotropy = anisotropy;
  return m;
}

/// A ball of radius 1 that fills the picture, in a sky of radiance 1.
Shot bodyBallShot(const CompiledMaterial& material, std::uint64_t samples) {
  CompiledScene scene = sphere(48, 1.0f, {0, 0, 0});
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 0, 3}, {0, 0, 0}, 0.3), 8, samples);
  shot.scene.materials[0] = material;
  shot.sky = Environment{2, 1, {glm::vec3(1.0f), glm::vec3(1.0f)}};
  shot.request.depth = 32;
  return shot;
}

glm::dvec3 bodyMean(const reference::Film& film) {
  glm::dvec3 mean(0.0);
  const Picture picture = film.picture();
  for (const glm::vec3& pixel : picture.pixels) mean += glm::dvec3(pixel) / double(picture.pixels.size());
  return mean;
}

TEST(BodyShot, WhiteBodyInAnEvenSky_IsTheSky) {
  for (const float anisotropy : {-0.4f, 0.0f, 0.8f}) {
    const glm::dvec3 mean =
        bodyMean(bodyBallShot(bodyOf(glm::vec3(5.0f), glm::vec3(1.0f), anisotropy), 256).render());
    EXPECT_NEAR(mean.x, 1.0, 0.006) << anisotropy;
  }
}

TEST(BodyShot, WhiteBodyThatReflectsWithin_IsTheSky) {
  CompiledMaterial m = translucent(1.0f, 0.5f, 1.0f);
  const CompiledMaterial inside = bodyOf(glm::vec3(3.0f), glm::vec3(1.0f), 0.0f);
  m.specular = 0.0f;
  m.roughness = 1.0f;
  m.solid = true;
  m.absorption = inside.absorption;
  m.scattering = inside.scattering;
  EXPECT_NEAR(bodyMean(bodyBallShot(m, 256).render()).x, 1.0, 0.006);
}

TEST(BodyShot, AbsorbingBody_FollowsBeersLawAlongItsChords) {
  const glm::vec3 extinction(0.3f, 1.0f, 2.0f);
  const glm::dvec3 mean = bodyMean(bodyBallShot(bodyOf(extinction, glm::vec3(0.0f), 0.0f), 256).render());
  for (int c = 0; c < 3; ++c) {
    const double x = 2.0 * double(extinction[c]);
    EXPECT_NEAR(mean[c], 2.0 * (1.0 - (1.0 + x) * std::exp(-x)) / (x * x), 0.008) << c;
  }
}

TEST(BodyShot, ScatteringBody_IsWhatWalksInDoubleSay) {
  const glm::vec3 extinction(2.0f, 5.0f, 8.0f), scattering(0.95f, 0.8f, 0.99f);
  const glm::dvec3 mean = bodyMean(bodyBallShot(bodyOf(extinction, scattering, 0.5f), 512).render());
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean[c], shareThroughBall(double(extinction[c]), double(scattering[c]), 0.5, 1u << 17), 0.008)
        << c;
}

// Milk in a glass: all light that enters through the refracting surface comes out again, so that the ball
// shows the sky as clear glass does.
TEST(BodyShot, WhiteMilkInGlass_IsTheSky) {
  CompiledMaterial m = glass(1.3f, true);
  m.absorption = glm::vec3(4.0f);
  m.scattering = glm::vec3(1.0f);
  Shot shot = bodyBallShot(m, 256);
  shot.request.depth = 64;
  EXPECT_NEAR(bodyMean(shot.render()).x, 1.0, 0.01);
}

}  // namespace
}  // namespace prelight::test
