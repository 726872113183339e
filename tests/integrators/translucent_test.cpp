#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shot.h"

// Light that comes through surfaces (KHR_materials_diffuse_transmission), against closed forms.
namespace prelight::test {
namespace {

using reference::Integrator;

using std::numbers::pi;
constexpr float through = 0.8f;  // Colour of the leaf.
constexpr double sun = 3.0;      // W/m2.

/// A material that transmits all light that its specular layer does not reflect.
CompiledMaterial leaf(float specular) {
  CompiledMaterial m = translucent(0.9f, 1.0f, through);
  m.specular = specular;
  m.roughness = 1.0f;
  return m;
}

Light sunFrom(const glm::dvec3& direction) {
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(static_cast<float>(sun));
  light.direction = direction;
  return light;
}

/// A sheet seen from above, lit from `direction`.
Shot sheetShot(const CompiledMaterial& material, const glm::dvec3& direction) {
  CompiledScene scene = ground(1, 1.0f);
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.1), 4, 64);
  shot.scene.materials[0] = material;
  shot.lights = {sunFrom(direction)};
  return shot;
}

class TranslucentSheetShot : public ::testing::TestWithParam<Integrator> {};

TEST_P(TranslucentSheetShot, LitFromTheCamerasSide_IsBlackWhereAllLightGoesThrough) {
  Shot shot = sheetShot(leaf(0.0f), {0, -1, 0});
  shot.request.integrator = GetParam();
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
}

TEST_P(TranslucentSheetShot, LitFromBehind_ShowsWhatComesThrough) {
  const double slant = 0.6;
  Shot shot = sheetShot(leaf(0.0f), glm::dvec3(std::sqrt(1.0 - slant * slant), slant, 0.0));
  shot.request.integrator = GetParam();
  for (const glm::vec3& pixel : shot.render().picture().pixels)
    EXPECT_NEAR(pixel.x, double(through) * sun * slant / pi, 1e-5);
}

TEST_P(TranslucentSheetShot, OfAQuarter_ReflectsTheRest) {
  Shot shot = sheetShot(translucent(0.8f, 0.25f, 0.5f), {0, -1, 0});
  shot.request.integrator = GetParam();
  for (const glm::vec3& pixel : shot.render().picture().pixels)
    EXPECT_NEAR(pixel.x, 0.75 * 0.8 * sun / pi, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Integrators, TranslucentSheetShot,
                         ::testing::Values(Integrator::Path, Integrator::Distributed, Integrator::Whitted,
                                           Integrator::Instant),
                         [](const auto& test) { return std::string(reference::integratorName(test.param)); });

/// The floor under the middle of a leaf of 4 x 4 m, 1 m above it, in the sun.
Shot floorUnderLeaf(float specular, Integrator integrator, std::uint64_t samples) {
  CompiledScene scene = ground(1, 6.0f);
  append(scene, ground(1, 2.0f, 1.0f));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 0.9, 0}, {0, 0, 0}, 0.05), 8, samples);
  shot.scene.materials[0] = lambert(0.5f);
  shot.scene.materials[1] = leaf(specular);
  shot.lights = {sunFrom({0, -1, 0})};
  shot.request.integrator = integrator;
  return shot;
}

/// Form factor of that leaf at that place (Howell, B-3: four times that of a quarter).
double leafFactor() {
  const double a = 2.0, r = std::sqrt(1.0 + a * a);
  return 4.0 / (2.0 * pi) * 2.0 * (a / r) * std::atan(a / r);
}

TEST(FloorUnderALeaf, IsLitByWhatComesThrough) {
  for (const Integrator integrator : {Integrator::Path, Integrator::Distributed}) {
    const MeanAndError found = meanOf(floorUnderLeaf(0.0f, integrator, 4096).render());
    const double expected = 0.5 / pi * sun * double(through) * leafFactor();
    ASSERT_LT(found.error, 0.01 * expected);
    EXPECT_NEAR(found.mean, expected, 4.0 * found.error) << reference::integratorName(integrator);
  }
}

/// A hundred or more virtual lights on the 16 m2 of the leaf shine down.
TEST(FloorUnderALeaf, IsLitByVirtualLights) {
  Shot shot = floorUnderLeaf(0.0f, Integrator::Instant, 24);
  shot.request.lightPaths = 2048;
  const MeanAndError found = meanOf(shot.render());
  const double expected = 0.5 / pi * sun * double(through) * leafFactor();
  EXPECT_NEAR(found.mean, expected, 4.0 * found.error + 0.02 * expected);
}

/// A layer reflects 0.04 of perpendicular light on its way in, and loses nothing else: the losses on the way
/// out, 1 - F in each direction, are compensated in the mean. The expected value is a quadrature over the
/// leaf.
TEST(FloorUnderALeaf, WithALayer_LosesWhatTheLayerReflects) {
  const double f0 = 0.04, mean = f0 + (1.0 - f0) / 21.0;
  double sum = 0.0;
  constexpr int cells = 400;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double x = 4.0 * (i + 0.5) / cells - 2.0, z = 4.0 * (k + 0.5) / cells - 2.0,
                   squared = 1.0 + x * x + z * z, cosine = 1.0 / std::sqrt(squared);
      const double leaves = 1.0 - f0 - (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
      sum += 16.0 / cells / cells / (pi * squared * squared) * leaves;
    }
  const double expected = 0.5 / pi * sun * double(through) * (1.0 - f0) / (1.0 - mean) * sum;
  Shot shot = floorUnderLeaf(1.0f, Integrator::Path, 4096);
  shot.scene.materials[1].roughness = 0.0f;
  const MeanAndError found = meanOf(shot.render());
  // Light from the floor that the layer reflects back down adds a few hundredths.
  EXPECT_GT(found.mean, expected - 4.0 * found.error);
  EXPECT_LT(found.mean, 1.04 * expected + 4.0 * found.error);
}

/// A closed room of albedo 1/2 whose walls emit 1 shows 2. So does a ball in it that absorbs nothing,
/// whatever share of the light passes through it.
TEST(Furnace, TranslucentBallThatAbsorbsNothing_IsNotSeen) {
  for (const float share : {0.3f, 1.0f}) {
    CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
    append(scene, sphere(8, 0.6f, {-0.2f, -0.2f, -0.3f}));
    scene.triangleFlat.assign(scene.triangles.size(), 1);
    Shot shot = shotOf(std::move(scene), cameraAt({0.8, 0.7, 0.8}, {-0.2, -0.2, -0.3}, 0.5), 6, 4096);
    shot.camera.zNear = 1e-3;
    shot.scene.materials[0] = lambert(0.5f);
    shot.scene.materials[0].emission = glm::vec3(1.0f);
    shot.scene.materials[1] = translucent(1.0f, share, 1.0f);
    shot.request.depth = 400;
    const MeanAndError found = meanOf(shot.render());
    ASSERT_LT(found.error, 0.01);
    EXPECT_NEAR(found.mean, 2.0, 4.0 * found.error) << share;
  }
}

/// Light that a smooth layer does not reflect enters, and all of it leaves again. A rough layer loses the
/// light that scatters more than once.
TEST(Furnace, TranslucentBallWithALayer_GainsNothing) {
  CompiledMaterial waxed = translucent(1.0f, 1.0f, 1.0f);
  waxed.specular = 1.0f;
  waxed.roughness = 0.0f;
  Shot shot = shotOf(sphere(12, 1.0f, {0, 0, 0}), orthographicCamera({0, 0, 5}, {0, 0, 0}, 0.6), 6, 1024);
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[0] = waxed;
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.depth = 400;
  const MeanAndError found = meanOf(shot.render());
  ASSERT_LT(found.error, 0.003);
  EXPECT_NEAR(found.mean, 1.0, 4.0 * found.error + 1e-4);
  shot.scene.materials[0].roughness = 0.5f;
  const MeanAndError rough = meanOf(shot.render());
  EXPECT_LT(rough.mean, 1.0 + 4.0 * rough.error);
}

/// Sampling a lamp behind a sheet and hitting it by chance have the same mean.
TEST(TranslucentSheet, LampBehindIt_IsFoundBySamplesOfItAndByPaths) {
  Shot shot = sheetShot(translucent(0.8f, 0.5f, 0.9f), {0, -1, 0});
  shot.lights.clear();
  append(shot.scene, ground(1, 0.5f, -0.5f));
  shot.scene.triangleFlat.assign(shot.scene.triangles.size(), 1);
  shot.scene.materials[1] = emitter(glm::vec3(2.0f));
  shot.request.depth = 2;
  shot.request.samples = 2048;
  std::vector<MeanAndError> found;
  for (const auto estimator :
       {reference::Estimator::LightsOnly, reference::Estimator::ScatterOnly, reference::Estimator::Both}) {
    shot.request.estimator = estimator;
    found.push_back(meanOf(shot.render()));
    ASSERT_LT(found.back().error, 0.01 * found.back().mean);
    EXPECT_NEAR(found.back().mean, found.front().mean, 4.0 * (found.back().error + found.front().error));
  }
  const double a = 1.0, r = std::sqrt(1.0 + a * a);  // Half a metre wide each way, half a metre away.
  const double factor = 4.0 / (2.0 * pi) * 2.0 * (a / r) * std::atan(a / r);
  EXPECT_NEAR(found.back().mean, 2.0 * 0.45 * factor, 0.02);
}

}  // namespace
}  // namespace prelight::test
