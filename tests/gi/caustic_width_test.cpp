// Tests the width over which caustics are spread in a map of coarse texels.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight {
namespace {

// Sunlight meets a mirror of 0.2 x 0.2 m at 45 degrees and goes on to the middle of a ceiling, whose only
// chart has texels of half a metre. Each photon is spread over at least 1.5 texels, so that none fall between
// texels.
TEST(LightMapCaustics, CoarseTexels_SpreadThemOverTheirWidth) {
  CompiledScene scene = test::ground(1, 0.1f);
  test::append(scene, test::sceneOf({{0, 2, -2}, {4, 2, -2}, {4, 2, 2}, {0, 2, 2}}, {{0, 1, 2}, {0, 2, 3}}));
  scene.materials = {test::metal(1.0f, 0.0f), test::lambert(0.5f)};
  scene.triangleMaterials = {0, 0, 1, 1};
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = glm::vec3(10.0f);
  sun.direction = glm::normalize(glm::dvec3(1.0, -1.0, 0.0));
  scene.lights = {sun};
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = 0.5;
  request.lightMap.caustics = true;
  request.effort.rays = 64;
  request.lightMap.photons = 20000;
  const Scene source;
  BakeReport report;
  Progress progress;
  const Bake bake = bakeScene(scene, request, makePlan(source, scene, request), test::sharedDevice(),
                              progress, report, nullptr, &source);
  ASSERT_TRUE(bake.lightMap);
  ASSERT_EQ(bake.lightMap->layout.chartCount, 1u);
  const float most = *std::max_element(bake.lightMap->values.begin(), bake.lightMap->values.end());
  const double flux = 10.0 * 0.04 / std::numbers::sqrt2, width = 1.5 * 0.5;
  // The photons are spread over a disc of that radius, with a kernel that is at most twice its mean in the
  // middle.
  EXPECT_LE(most, 2.2 * flux / (std::numbers::pi * width * width));
  EXPECT_GE(most, 0.3 * flux / (std::numbers::pi * width * width));
}

}  // namespace
}  // namespace prelight
