#include <gtest/gtest.h>

#include "prelight/error.h"
#include "support/shot.h"

// Instant radiosity against path tracing.
namespace prelight::test {
namespace {

using reference::Film;
using reference::Integrator;

/// A room of albedo 0.6 with a crate, lit by a point light, seen from within.
Shot litRoom(Integrator integrator, std::uint64_t samples) {
  CompiledScene scene = box(1, glm::vec3(-2.0f), glm::vec3(2.0f), true);
  append(scene, box(1, {-0.5f, -2.0f, -0.5f}, {0.5f, -0.8f, 0.5f}, false));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Shot shot = shotOf(std::move(scene), cameraAt({1.6, 0.5, 1.7}, {-0.5, -0.7, -0.5}, 1.2), 12, samples);
  shot.camera.zNear = 1e-3;
  for (CompiledMaterial& material : shot.scene.materials) material = lambert(0.6f);
  Light lamp;
  lamp.intensity = glm::vec3(8.0f);
  lamp.position = {1.2, 1.4, -0.6};
  shot.lights = {lamp};
  shot.request.integrator = integrator;
  shot.request.depth = 8;
  shot.request.lightPaths = 256;
  return shot;
}

TEST(InstantRadiosity, RoomWithALamp_IsWhatPathsFind) {
  const MeanAndError path = meanOf(litRoom(Integrator::Path, 1024).render());
  const MeanAndError instant = meanOf(litRoom(Integrator::Instant, 24).render());
  ASSERT_LT(path.error, 0.005 * path.mean);
  // Instant radiosity misses a little light, clamped near virtual lights, and may add none.
  EXPECT_LT(instant.mean, path.mean + 4.0 * (path.error + instant.error));
  EXPECT_GT(instant.mean, 0.97 * path.mean - 4.0 * (path.error + instant.error));
}

// Coat and sheen hold back the light that leaves virtual lights; their own scattering is not diffuse light.
TEST(InstantRadiosity, RoomOfCoatedWalls_IsWhatPathsFind) {
  const auto coated = [](Integrator integrator, std::uint64_t samples) {
    Shot shot = litRoom(integrator, samples);
    for (CompiledMaterial& m : shot.scene.materials) {
      m.clearcoat.factor = 1.0f;
      m.clearcoat.roughness = 0.8f;
      m.sheen.color = glm::vec3(0.5f);
      m.sheen.roughness = 0.6f;
    }
    return shot;
  };
  const MeanAndError path = meanOf(coated(Integrator::Path, 1024).render());
  const MeanAndError instant = meanOf(coated(Integrator::Instant, 24).render());
  ASSERT_LT(path.error, 0.005 * path.mean);
  EXPECT_LT(instant.mean, path.mean + 4.0 * (path.error + instant.error));
  EXPECT_GT(instant.mean, 0.97 * path.mean - 4.0 * (path.error + instant.error));
}

TEST(InstantRadiosity, WithoutBounces_IsDirectLight) {
  Shot path = litRoom(Integrator::Path, 256), instant = litRoom(Integrator::Instant, 64);
  path.request.depth = instant.request.depth = 2;
  const MeanAndError expected = meanOf(path.render()), found = meanOf(instant.render());
  EXPECT_NEAR(found.mean, expected.mean, 4.0 * (expected.error + found.error) + 1e-6);
}

TEST(InstantRadiosity, SameSeed_SamePicture_OtherSeed_AnotherOne) {
  Shot shot = litRoom(Integrator::Instant, 2);
  const Picture a = shot.render().picture(), b = shot.render().picture();
  shot.request.seed = 1;
  const Picture c = shot.render().picture();
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_NE(a.pixels, c.pixels);
}

}  // namespace
}  // namespace prelight::test
