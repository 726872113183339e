#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shot.h"

// A blended surface counts by its alpha, as seen from the eye and from lights.
namespace prelight::test {
namespace {

using reference::Estimator;
using reference::Integrator;
using std::numbers::pi;

constexpr double sunshine = 3.0;  // W/m2.

Light sunFromAbove() {
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(float(sunshine));
  light.direction = {0, -1, 0};
  return light;
}

class BlendedCard : public ::testing::TestWithParam<float> {};

TEST_P(BlendedCard, BeforeTheEye_MixesWithWhatLiesBehind) {
  Shot shot = shotOf(ground(1, 1.0f), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.05), 16, 1024);
  shot.scene.materials[0] = blendedOf(emitter(glm::vec3(3.0f)), GetParam());
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  const MeanAndError found = meanOf(shot.render());
  EXPECT_NEAR(found.mean, double(GetParam()) * 3.0 + 1.0 - double(GetParam()), 4.0 * found.error + 1e-6);
  EXPECT_LT(found.error, 0.01);
}

TEST_P(BlendedCard, InTheSun_CastsAPartialShadow) {
  for (const Integrator integrator : {Integrator::Path, Integrator::Whitted}) {
    CompiledScene scene = ground(1, 6.0f);
    append(scene, ground(1, 2.0f, 1.0f));
    Shot shot = shotOf(std::move(scene), orthographicCamera({0, 0.9, 0}, {0, 0, 0}, 0.05), 16, 1024);
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[1] = blendedOf(lambert(0.0f), GetParam());
    shot.lights = {sunFromAbove()};
    shot.request.integrator = integrator;
    const MeanAndError found = meanOf(shot.render());
    EXPECT_NEAR(found.mean, (1.0 - double(GetParam())) * 0.5 / pi * sunshine, 4.0 * found.error + 1e-6);
    EXPECT_LT(found.error, 0.02);
  }
}

// Sampling the card and hitting it by chance find the same light.
TEST_P(BlendedCard, ThatShines_LightsByItsShare) {
  CompiledScene scene = ground(1, 6.0f);
  append(scene, ground(1, 1.0f, 1.0f));
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 0.9, 0}, {0, 0, 0}, 0.05), 16, 4096);
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[1] = emitter(glm::vec3(2.0f));
  shot.scene.materials[1].doubleSided = true;
  shot.request.depth = 2;
  const double opaque = meanOf(shot.render()).mean;
  shot.scene.materials[1] = blendedOf(shot.scene.materials[1], GetParam());
  for (const Estimator estimator : {Estimator::Both, Estimator::LightsOnly, Estimator::ScatterOnly}) {
    shot.request.estimator = estimator;
    const MeanAndError found = meanOf(shot.render());
    EXPECT_NEAR(found.mean, double(GetParam()) * opaque, 4.0 * found.error + 2e-3 * opaque) << int(estimator);
  }
}

INSTANTIATE_TEST_SUITE_P(Alphas, BlendedCard, ::testing::Values(0.0f, 0.3f, 0.75f, 1.0f));

}  // namespace
}  // namespace prelight::test
