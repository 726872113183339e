// Backs of one-sided surfaces: the eye looks through them, but light does not pass.
#include <gtest/gtest.h>

#include <array>

#include "integrators/global_illumination_renderer.h"
#include "support/devices.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

using reference::Integrator;

constexpr float glow = 2.0f;
constexpr std::array integrators = {Integrator::Whitted, Integrator::Distributed, Integrator::Path,
                                    Integrator::Instant};

/// A square of half side 1 at y = `height`, facing up or down.
CompiledScene sheet(float height, bool up) {
  CompiledScene scene = ground(1, 1.0f, height);
  if (!up)
    for (glm::uvec3& t : scene.triangles) std::swap(t.y, t.z);
  if (!up)
    for (glm::vec3& n : scene.normals) n = -n;
  return scene;
}

/// A glowing ground, seen from above through a one-sided sheet of a material that faces down.
Shot overGlow(const CompiledMaterial& between) {
  Shot shot = shotOf(sheet(0.0f, true), orthographicCamera({0, 3, 0}, {0, 0, 0}, 0.3), 4, 4);
  append(shot.scene, sheet(1.0f, false));
  shot.scene.materials = {emitter(glm::vec3(glow)), between};
  return shot;
}

double radianceOf(const Shot& shot) { return meanOf(shot.render()).mean; }

TEST(CulledBacks, EyeLooksThroughThem_WhateverIntegrator) {
  for (const Integrator integrator : integrators) {
    Shot shot = overGlow(lambert(0.0f));
    shot.request.integrator = integrator;
    EXPECT_NEAR(radianceOf(shot), glow, 1e-6);
    shot.scene.materials[1].doubleSided = true;
    EXPECT_EQ(radianceOf(shot), 0.0);
  }
}

TEST(CulledBacks, Fronts_AreSeen) {
  Shot shot = overGlow(lambert(0.0f));
  // Sees the ground's back, then the sheet's front.
  shot.camera = orthographicCamera({0, -3, 0}, {0, 0, 0}, 0.3);
  EXPECT_EQ(radianceOf(shot), 0.0);
}

TEST(CulledBacks, SeveralOneBehindTheOther_AreLookedThrough) {
  Shot shot = overGlow(lambert(0.0f));
  for (int i = 0; i < 5; ++i) {
    append(shot.scene, sheet(1.1f + 0.1f * static_cast<float>(i), false));
    shot.scene.materials.back() = lambert(0.0f);
  }
  EXPECT_NEAR(radianceOf(shot), glow, 1e-6);
}

/// Only the sky is behind the sheet.
TEST(CulledBacks, BeforeTheSky_ShowIt) {
  Shot shot = shotOf(sheet(1.0f, false), orthographicCamera({0, 3, 0}, {0, 0, 0}, 0.3), 4, 4);
  shot.scene.materials[0] = lambert(0.5f);
  shot.sky = constantEnvironment(glm::vec3(3.0f));
  EXPECT_NEAR(radianceOf(shot), 3.0, 1e-5);
}

TEST(CulledBacks, FarPlane_CutsWhatLiesBeyondThem) {
  Shot shot = overGlow(lambert(0.0f));
  shot.camera.zFar = 2.9;  // Between sheet and ground.
  EXPECT_EQ(radianceOf(shot), 0.0);
  shot.camera.zFar = 3.1;
  EXPECT_NEAR(radianceOf(shot), glow, 1e-6);
}

TEST(CulledBacks, MirrorsShowWhatTheEyeWould) {
  // The eye looks up from below at a mirror, which shows the glowing ground through the sheet.
  Shot shot = overGlow(lambert(0.0f));
  append(shot.scene, sheet(2.0f, false));
  shot.scene.materials[2] = metal(1.0f, 0.0f);
  shot.camera = orthographicCamera({0, 1.5, 0}, {0, 2, 0}, 0.3);
  EXPECT_NEAR(radianceOf(shot), glow, 1e-5);
  shot.scene.materials[1].doubleSided = true;
  EXPECT_NEAR(radianceOf(shot), 0.0, 1e-6);
}

/// Light does not pass through the one-sided sheet to the white sheet above it, neither by sampled lamps nor
/// along paths.
TEST(CulledBacks, LightMeetsWalls) {
  Shot shot = overGlow(lambert(0.0f));
  append(shot.scene, sheet(2.0f, false));
  shot.scene.materials[2] = lambert(1.0f);
  shot.scene.materials[2].doubleSided = true;
  // Makes the lower sheet larger than the sheet above it.
  for (const std::uint32_t v : {4u, 5u, 6u, 7u}) {
    shot.scene.positions[v].x *= 100.0f;
    shot.scene.positions[v].z *= 100.0f;
  }
  shot.camera = orthographicCamera({0, 1.5, 0}, {0, 2, 0}, 0.3);
  for (const auto estimator :
       {reference::Estimator::Both, reference::Estimator::LightsOnly, reference::Estimator::ScatterOnly}) {
    shot.request.estimator = estimator;
    EXPECT_EQ(radianceOf(shot), 0.0);
  }
}

TEST(CulledBacks, BodiesOfGlass_HaveNone) {
  Shot shot = overGlow(glass(1.5f, true));
  // Glass has no culled backs: reflection and scaling at its faces change the radiance.
  EXPECT_NE(radianceOf(shot), double{glow});
}

/// A closed room that faces inwards, seen from outside. Its near wall is see-through for the eye and still
/// holds back the light.
TEST(CulledBacks, DollHouse_LooksAlikeTracedAndFromCachedLight) {
  Shot shot =
      shotOf(box(4, glm::vec3(-1.0f), glm::vec3(1.0f), true), cameraAt({0, 0, 4}, {0, 0, 0}, 0.6), 12, 1024);
  shot.scene.materials[0] = lambert(0.5f);
  Light lamp;
  lamp.intensity = glm::vec3(1.0f);
  lamp.position = {0.2, 0.5, 0.1};
  shot.lights = {lamp};
  const Picture truth = shot.render().picture();
  const LitScene lit{shot.scene, noImages(), shot.lights, nullptr};
  GlobalIlluminationPictureRequest request;
  request.width = request.height = 12;
  request.samples = 16;
  GlobalIlluminationPictureReport report;
  Progress progress;
  const Picture cached =
      renderGlobalIllumination(Scene{}, lit, shot.camera, request, sharedDevice(), progress, report);
  double sum = 0.0, cachedSum = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    sum += static_cast<double>(truth.pixels[i].y);
    cachedSum += static_cast<double>(cached.pixels[i].y);
  }
  EXPECT_GT(sum, 1.0);
  EXPECT_NEAR(cachedSum, sum, 0.02 * sum);
}

}  // namespace
}  // namespace prelight::test
