#include "charts/seam_stitching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "charts/layout_places.h"
#include "charts/make_light_map_layout.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

LightMap mapOf(const CompiledScene& scene, double texelSize) {
  LightMapLayoutRequest request;
  request.texelSize = texelSize;
  LightMap map;
  map.layout = makeLightMapLayout(Scene{}, scene, request);
  map.values.assign(3 * map.layout.texelCount(), 0.0f);
  return map;
}

std::vector<SeamPoint> seamsOf(const CompiledScene& scene, const LightMap& map, double creaseAngle) {
  Tracer tracer(scene, test::sharedDevice());
  return prelight::seamsOf(scene, tracer, map.layout, creaseAngle);
}

/// Fills the map with a function of position and with independent noise per texel.
void fill(const CompiledScene& scene, double noise, LightMap& map) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, noise);
  for (const LightMapTexel& texel : map.layout.texels) {
    const glm::dvec3 p = test::positionOf(scene, texel);
    for (std::size_t c = 0; c < 3; ++c)
      map.values[3 * texel.texel + c] =
          static_cast<float>(2.0 + p.x + 0.5 * p.y * double(c) + (noise > 0.0 ? normal(random) : 0.0));
  }
}

TEST(SeamStitching, Noise_IsTheSameOnBothSides) {
  const CompiledScene scene = test::sphere(32, 1.0f, glm::vec3(0.0f));
  LightMap map = mapOf(scene, 0.05);
  fill(scene, 0.2, map);
  const std::vector<SeamPoint> seams = seamsOf(scene, map, usualCreaseAngle);
  ASSERT_GT(seams.size(), 100u);
  const double before = seamJump(map, seams);
  EXPECT_GT(before, 0.1);
  const std::vector<float> old = map.values;
  stitchSeams(seams, map);
  EXPECT_LT(seamJump(map, seams), 0.15 * before);
  // Values change by no more than the noise.
  double change = 0.0, count = 0.0;
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old[i] == map.values[i]) continue;
    change += std::pow(double(old[i]) - double(map.values[i]), 2.0);
    ++count;
  }
  EXPECT_LT(std::sqrt(change / count), 0.2);
}

TEST(SeamStitching, ASmoothLight_HasHardlyAJump) {
  const CompiledScene scene = test::sphere(32, 1.0f, glm::vec3(0.0f));
  LightMap map = mapOf(scene, 0.05);
  fill(scene, 0.0, map);
  const std::vector<SeamPoint> seams = seamsOf(scene, map, usualCreaseAngle);
  const double before = seamJump(map, seams);
  EXPECT_LT(before, 0.025);  // Half a texel, at a slope of 1.
  stitchSeams(seams, map);
  EXPECT_LT(seamJump(map, seams), 0.5 * before);
}

TEST(SeamStitching, Creases_AreNoSeams) {
  const CompiledScene scene = test::box(2, glm::vec3(0.0f), glm::vec3(1.0f), false);
  const LightMap map = mapOf(scene, 0.1);
  EXPECT_TRUE(seamsOf(scene, map, usualCreaseAngle).empty());
  EXPECT_FALSE(seamsOf(scene, map, 1.6).empty());
}

TEST(SeamStitching, EqualValues_StayAsTheyAre) {
  const CompiledScene scene = test::sphere(16, 1.0f, glm::vec3(0.0f));
  LightMap map = mapOf(scene, 0.1);
  for (const LightMapTexel& texel : map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c) map.values[3 * texel.texel + c] = 3.5f;
  const std::vector<float> old = map.values;
  stitchSeams(seamsOf(scene, map, usualCreaseAngle), map);
  for (std::size_t i = 0; i < old.size(); ++i) ASSERT_NEAR(map.values[i], old[i], 1e-6);
}

TEST(SeamStitching, Irradiance_DoesNotFallBelowZero) {
  const CompiledScene scene = test::sphere(16, 1.0f, glm::vec3(0.0f));
  LightMap map = mapOf(scene, 0.1);
  std::mt19937 random(3);
  for (const LightMapTexel& texel : map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c) map.values[3 * texel.texel + c] = random() % 8 == 0 ? 100.0f : 0.0f;
  stitchSeams(seamsOf(scene, map, usualCreaseAngle), map);
  for (const float value : map.values) ASSERT_GE(value, 0.0f);
}

TEST(LightMapLookUp, BetweenTexels_IsBilinear) {
  LightMapLayout layout;
  layout.width = 4;
  layout.height = 3;
  const LightMapLookUp at = lookUp(layout, {1.75, 1.5});
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += at.weights[i];
    const double expected = at.texels[i] == 5u ? 0.75 : at.texels[i] == 6u ? 0.25 : 0.0;
    EXPECT_DOUBLE_EQ(at.weights[i], expected);
  }
  EXPECT_DOUBLE_EQ(sum, 1.0);
}

}  // namespace
}  // namespace prelight
