#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pane_glass.h"
#include "support/shot.h"

// Light that passes straight through thin glass counts as direct light: shadow rays carry it, for every kind
// of light.
namespace prelight::test {
namespace {

using reference::Estimator;
using reference::Integrator;
using std::numbers::pi;

constexpr float albedo = 0.5f;
const glm::vec3 tint{0.9f, 0.8f, 0.5f};
const double tintLuminance = 0.2126 * 0.9 + 0.7152 * 0.8 + 0.0722 * 0.5;

/// A floor seen through a gap below one or several panes.
Shot floorUnder(int panes, std::uint64_t samples) {
  CompiledScene scene = ground(1, 6.0f);
  for (int i = 0; i < panes; ++i) append(scene, ground(1, 6.0f, 1.0f + 0.1f * float(i)));
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 0.9, 0}, {0, 0, 0}, 0.01), 4, samples);
  for (CompiledMaterial& material : shot.scene.materials) {
    material = glass(1.5f, false);
    material.baseColor = tint;
  }
  shot.scene.materials[0] = lambert(albedo);
  shot.request.depth = 2;
  return shot;
}

Light sunFrom(double angle) {
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(3.0f);
  light.direction = {std::sin(angle), -std::cos(angle), 0};
  return light;
}

void addLamp(Shot& shot, float half, float height) {
  CompiledScene lamp = ground(1, half, height);
  for (glm::uvec3& triangle : lamp.triangles) std::swap(triangle.y, triangle.z);  // Faces down.
  for (glm::vec3& normal : lamp.normals) normal = -normal;
  lamp.materials[0] = emitter(glm::vec3(2.0f));
  append(shot.scene, lamp);
}

TEST(Pane, UnderTheSun_DimsItByItsTransmittance) {
  for (const Integrator integrator : {Integrator::Path, Integrator::Distributed, Integrator::Whitted})
    for (const double angle : {0.0, 0.7, 1.3})
      for (const int panes : {1, 2}) {
        Shot shot = floorUnder(panes, 16);
        shot.lights = {sunFrom(angle)};
        shot.request.integrator = integrator;
        const double open = albedo / pi * 3.0 * std::cos(angle), cosine = std::cos(angle);
        const glm::dvec3 through = glm::pow(paneTransmittance(cosine) * glm::dvec3(tint), glm::dvec3(panes));
        const Picture picture = shot.render().picture();
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(picture.pixels[0][c], open * through[c], 1e-4 * open) << angle << " " << panes;
      }
}

TEST(Pane, UnderALamp_BothWaysToFindItAgree) {
  const double expected =
      albedo / pi * 2.0 * tintLuminance *
      irradianceOfSquare({0, 0, 0}, {0, 2, 0}, 1.0, [](double c) { return paneTransmittance(c); });
  for (const Estimator estimator : {Estimator::Both, Estimator::LightsOnly, Estimator::ScatterOnly}) {
    Shot shot = floorUnder(1, 2048);
    addLamp(shot, 1.0f, 2.0f);
    shot.request.estimator = estimator;
    const MeanAndError found = meanOf(shot.render());
    EXPECT_NEAR(found.mean, expected, 4.0 * found.error + 1e-3 * expected) << int(estimator);
    EXPECT_LT(found.error, 0.02 * expected);
  }
}

TEST(Pane, UnderASky_DimsItByItsTransmittance) {
  double passed = 0.0;
  for (int i = 0; i < 1000; ++i) {
    // Square of the cosine, evenly distributed over the light that arrives.
    const double square = (i + 0.5) / 1000.0;
    passed += paneTransmittance(std::sqrt(square)) / 1000.0;
  }
  Shot shot = floorUnder(1, 1024);
  for (glm::vec3& position : shot.scene.positions)
    if (position.y > 0.5f) position *= glm::vec3(1000.0f, 1.0f, 1000.0f);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  const MeanAndError found = meanOf(shot.render());
  EXPECT_NEAR(found.mean, albedo * passed * tintLuminance, 4.0 * found.error + 2e-3);
  EXPECT_LT(found.error, 0.01);
}

TEST(Pane, BeforeTheEye_ShowsWhatLiesBehindAtAnyDepth) {
  for (const int depth : {1, 2}) {
    Shot shot = floorUnder(3, 256);
    shot.camera = orthographicCamera({0, 3, 0}, {0, 0, 0}, 0.01);
    shot.scene.materials[0] = emitter(glm::vec3(2.0f));
    shot.request.depth = depth;
    const MeanAndError found = meanOf(shot.render());
    double expected = 2.0;
    for (int i = 0; i < 3; ++i) expected *= paneTransmittance(1.0);
    const glm::dvec3 color = glm::pow(glm::dvec3(tint), glm::dvec3(3.0));
    EXPECT_NEAR(found.mean, expected * glm::dot(color, {0.2126, 0.7152, 0.0722}), 4.0 * found.error + 1e-3);
  }
}

}  // namespace
}  // namespace prelight::test
