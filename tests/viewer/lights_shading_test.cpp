// Pictures with light groups whose factors are chosen for drawing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prelight/error.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

/// A quad with two light groups of 0.5 and 0.25 times their colours at every vertex.
QuadScene groupedQuad(int channels) {
  QuadScene quad;
  quad.add(lambertian({0.9f, 0.7f, 0.5f}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Point, {10, 10, 10}, {0, 0, 3})};
  quad.compile();
  LightGroupTransfer transfer{{{"lamp", {2, 3, 4}}, {"sign", {8, 0, 4}}}, channels, 0, {}};
  for (int v = 0; v < 4; ++v) {
    for (int c = 0; c < channels; ++c) {
      const float factor = channels == 1 ? 1.0f : 1.0f - 0.25f * static_cast<float>(c);
      transfer.coefficients.insert(transfer.coefficients.end(), {0.5f * factor, 0.25f * factor});
    }
  }
  quad.bake.lightGroups = transfer;
  return quad;
}

TEST(LightsShading, Groups_AddUpToAlbedoColourFactorAndTransfer) {
  viewer::RenderOptions options = square(Shading::Lights);
  expectColor(pixelAt(groupedQuad(1).render(options)), {0.9 * 3, 0.7 * 1.5, 0.5 * 3}, 1e-5);
  expectColor(pixelAt(groupedQuad(3).render(options)), {0.9 * 3, 0.7 * 0.75 * 1.5, 0.5 * 0.5 * 3}, 1e-5);
  options.groups = {{"lamp", {0, 0, 0}}, {"sign", {0.5f, 1, 2}}};
  expectColor(pixelAt(groupedQuad(1).render(options)), {0.9 * 1, 0, 0.5 * 2}, 1e-5);
}

/// The light of groups is not the sky's, of which nothing is known.
TEST(LightsShading, Reflections_ShowTheLightOfGroupsAndNoSky) {
  QuadScene quad = groupedQuad(1);
  Material& metal = quad.scene.materials[0];
  metal.metallic = 1.0f;
  metal.roughness = 0.5f;
  quad.scene.lights.clear();
  quad.compile();
  const glm::vec3 dark = pixelAt(quad.render(square(Shading::Lights)));
  EXPECT_GT(dark.r, 0.9f);
  quad.setSky(constantEnvironment(glm::vec3(5.0f)));
  expectColor(pixelAt(quad.render(square(Shading::Lights))), dark, 1e-6);
}

TEST(LightsShading, UnknownGroup_IsAnErrorThatListsThem) {
  viewer::RenderOptions options = square(Shading::Lights);
  options.groups = {{"lamb", glm::vec3(2)}};
  try {
    groupedQuad(1).render(options);
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("lamb"), testing::HasSubstr("lamp, sign")));
  }
}

TEST(LightsShading, EmissiveNodeOfAGroup_GlowsByItsFactor) {
  QuadScene quad;
  Material lamp = lambertian(glm::vec3(0));
  lamp.emission = {4, 2, 1};
  quad.add(lamp);
  quad.scene.meshNodes[0].name = "lamp";
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.compile();
  quad.bake.lightGroups = LightGroupTransfer{{{"lamp", {4, 2, 1}}}, 1, 0, {0, 0, 0, 0}};
  viewer::RenderOptions options = square(Shading::Lights);
  expectColor(pixelAt(quad.render(options)), {4, 2, 1}, 1e-5);
  options.groups = {{"lamp", {0.5f, 2, 3}}};
  expectColor(pixelAt(quad.render(options)), {2, 4, 3}, 1e-5);
}

}  // namespace
}  // namespace prelight
