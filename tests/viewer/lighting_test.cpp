#include "viewer/lights/lighting.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "viewer/quad_scene.h"

namespace prelight::viewer {
namespace {

using test::lambertian;
using test::QuadScene;

QuadScene twoLamps() {
  QuadScene lamps;
  Material lamp = lambertian(glm::vec3(0));
  lamp.emission = glm::vec3(3);
  lamps.add(lamp, 1.0f);
  lamps.add(lamp, 2.0f, glm::translate(glm::dmat4(1.0), glm::dvec3(10, 0, 0)));
  lamps.compile();
  return lamps;
}

TEST(Emitters, Samples_OfTwoLamps_HaveTheirAreaAndShareByPower) {
  const QuadScene lamps = twoLamps();
  const auto samples = sampleEmitters(lamps.compiled, glowingBodies(lamps.compiled), 40);
  ASSERT_EQ(samples.size(), 40u);
  double area = 0.0;
  int onLarger = 0;
  for (const ShadedLight& sample : samples) {
    area += sample.area;
    if (sample.position.x + lamps.compiled.origin.x > 5.0) ++onLarger;
    EXPECT_EQ(sample.direction, glm::vec3(0, 0, 1));
    EXPECT_NEAR(sample.position.z, 0.0f, 1e-6f);
  }
  EXPECT_NEAR(area, 4.0 + 16.0, 1e-4);
  EXPECT_EQ(onLarger, 32);
}

TEST(Emitters, Samples_OfAClosedTwoSidedLamp_ShineOutOfItAlone) {
  for (const bool inward : {false, true}) {
    CompiledScene lamp = test::box(2, {-1, 2, -1}, {1, 2.2f, 1}, inward);
    lamp.materials[0].emission = glm::vec3(2.0f);
    lamp.materials[0].doubleSided = true;
    for (const ShadedLight& sample : sampleEmitters(lamp, glowingBodies(lamp), 32)) {
      EXPECT_FALSE(sample.twoSided);
      EXPECT_GT(glm::dot(sample.direction, sample.position - glm::vec3(0, 2.1f, 0)), 0.0f);
    }
    EXPECT_TRUE(sampleEmitters(lamp, {}, 32)[0].twoSided);
  }
}

TEST(Emitters, Samples_OfNothing_AreNone) {
  QuadScene dark;
  dark.add(lambertian(glm::vec3(1)));
  dark.compile();
  EXPECT_TRUE(sampleEmitters(dark.compiled, {}, 32).empty());
  EXPECT_TRUE(sampleEmitters(CompiledScene(), {}, 32).empty());
}

TEST(Lights, WithinTheBounds_DoNotGoThroughTheTransfer) {
  const QuadScene lamps = twoLamps();
  Light light;
  light.position = {5, 0, 1};
  EXPECT_TRUE(shadedLight(light, lamps.compiled).throughTransfer);
  light.position = {5, 0, 0};
  EXPECT_FALSE(shadedLight(light, lamps.compiled).throughTransfer);
  light.type = LightType::Directional;
  EXPECT_TRUE(shadedLight(light, lamps.compiled).throughTransfer);
}

TEST(Lights, OfAnAreaThatReachesIntoTheBounds_DoNotGoThroughTheTransfer) {
  const CompiledScene box = test::box(2, {-1, 2, -1}, {1, 2.2f, 1}, false);
  Light light;
  light.type = LightType::Area;
  light.direction = {0, -1, 0};
  light.side = {1, 0, 0};
  light.position = {1.5, 2.1, 0};
  for (const auto& [radius, reachesIn] : {std::pair(0.3, false), {1.0, true}}) {
    light.shape = std::make_shared<const LightShape>(LightShape{ShapeKind::Disk, radius, {}});
    EXPECT_EQ(shadedLight(light, box).throughTransfer, !reachesIn) << radius;
  }
}

TEST(Sky, Turned_BackAndForth_IsTheSame) {
  const SkyCoefficients sky(test::halvedSky(), 6);
  const auto straight = sky.turned(0.0, 6);
  const auto full = sky.turned(2.0 * 3.14159265358979323846, 6);
  for (std::size_t i = 0; i < straight.size(); ++i)
    EXPECT_NEAR(glm::length(straight[i] - full[i]), 0.0, 1e-12);
}

}  // namespace
}  // namespace prelight::viewer
