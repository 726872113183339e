#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "basis/sh_zonal.h"
#include "compress/small_floats.h"
#include "prelight/picture.h"
#include "techniques/near_lamps/lamp_shells.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/options/light_option.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/near_lamps/near_lamp_pass.h"

namespace prelight {
namespace {

using test::expectColor;
using test::pixelAt;
using test::QuadScene;
using test::squareByBake;
using viewer::Shading;

constexpr auto lampPi = static_cast<float>(std::numbers::pi);
constexpr int shellBands = 4;

/// Bakes shells whose first one blocks `blocked` of the light from the whole hemisphere, at every vertex.
void blockFirstShell(QuadScene& quad, double blocked) {
  NearLampTransfer lamps{shellBands, 2, 0.1, 10.0, {}};
  std::vector<double> open(lamps.columns());
  sh::openTransfer({0, 0, 1}, shellBands, open);
  for (std::uint32_t v = 0; v < quad.compiled.vertexCount(); ++v)
    for (int shell = 0; shell < 2; ++shell)
      for (const double value : open)
        lamps.halves.push_back(toHalf(shell == 0 ? static_cast<float>(blocked * value) : 0.0f));
  quad.bake.nearLamps = lamps;
}

/// The middle of a draft picture, as a window draws it while something moves.
glm::vec3 draftPixel(const QuadScene& quad) {
  const viewer::RenderOptions options = squareByBake(Shading::Sh);
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(quad.inputs());
  viewer::View view = viewer::makeView(quad.inputs(), options);
  view.draft = true;
  return pixelAt(viewer::renderView(renderer, view, 1));
}

/// A white quad that faces +Z in a scene 6 m deep, lit by a lamp above its middle and seen obliquely. The
/// first shell blocks `blocked` of the light from the whole hemisphere.
glm::vec3 lampOver(double distance, double blocked, bool withShells, Shading shading = Shading::Sh) {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)), 0.02f);
  quad.add(test::lambertian(glm::vec3(1)), 2.0f, glm::translate(glm::dmat4(1.0), {0, 0, 6}));
  quad.lookFrom({0.02, 0, 0.1}, {0, 0, 0});
  quad.scene.lights = {
      test::makeLight(LightType::Point, glm::vec3(lampPi * float(distance * distance)), {0, 0, distance})};
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.compile();
  quad.bakeOpen(3);
  quad.bake.ch = quad.bake.sh;
  if (withShells) blockFirstShell(quad, blocked);
  return pixelAt(quad.render(squareByBake(shading)));
}

TEST(NearLampShading, LampBehindWhatBlocks_IsDark) {
  expectColor(lampOver(5.0, 1.0, false), glm::dvec3(1), 2e-3);
  expectColor(lampOver(5.0, 1.0, true), glm::dvec3(0), 1e-6);
  expectColor(lampOver(5.0, 1.0, true, Shading::Ch), glm::dvec3(0), 1e-6);
}

/// The quad of lampOver() under an emissive square that faces it.
glm::vec3 panelOver(double distance, double blocked, bool withShells, bool draft = false) {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)), 0.02f);
  Material glowing = test::lambertian(glm::vec3(0));
  glowing.emission = glm::vec3(20);
  quad.add(glowing, 0.2f,
           glm::rotate(glm::translate(glm::dmat4(1.0), {0, 0, distance}), std::numbers::pi, {1, 0, 0}));
  quad.add(test::lambertian(glm::vec3(0)), 2.0f, glm::translate(glm::dmat4(1.0), {0, 0, 6}));
  quad.lookFrom({0.02, 0, 0.1}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.compile();
  quad.bakeOpen(3);
  if (withShells) blockFirstShell(quad, blocked);
  return draft ? draftPixel(quad) : pixelAt(quad.render(squareByBake(Shading::Sh)));
}

TEST(NearLampShading, EmissiveSurfaceBehindWhatBlocks_IsDark_InDraftsToo) {
  EXPECT_GT(panelOver(3.0, 1.0, false).x, 0.02f);
  expectColor(panelOver(3.0, 1.0, true), glm::dvec3(0), 1e-6);
  EXPECT_GT(panelOver(3.0, 1.0, false, true).x, 0.02f);
  expectColor(panelOver(3.0, 1.0, true, true), glm::dvec3(0), 1e-6);
}

TEST(NearLampShading, EmissiveSurfaceBeforeWhatBlocks_IsAsWithoutShells) {
  const glm::vec3 plain = panelOver(0.15, 1.0, false);
  expectColor(panelOver(0.15, 1.0, true), glm::dvec3(plain), 1e-4 * plain.x);
}

TEST(NearLampShading, LampBeforeWhatBlocks_IsAsWithoutShells) {
  const glm::vec3 plain = lampOver(0.15, 1.0, false);
  expectColor(lampOver(0.15, 1.0, true), glm::dvec3(plain), 1e-5);
}

TEST(NearLampShading, PartOfAShell_IsWhatTheHostFinds) {
  const NearLampTransfer range{1, 2, 0.1, 10.0, {}};
  for (const double blocked : {0.5, 0.7}) {
    const double visibility = 1.0 - blocked * shareBefore(range, 0, 2.0);
    ASSERT_LT(sharpened(visibility), 1.0);
    expectColor(lampOver(2.0, blocked, true),
                sharpened(visibility) * glm::dvec3(lampOver(2.0, blocked, false)), 4e-3);
  }
}

/// The quad of lampOver() under an area light.
glm::vec3 diskOver(double distance, double blocked, bool withShells, Shading shading = Shading::Sh) {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)), 0.02f);
  quad.add(test::lambertian(glm::vec3(1)), 2.0f, glm::translate(glm::dmat4(1.0), {0, 0, 6}));
  quad.lookFrom({0.02, 0, 0.1}, {0, 0, 0});
  quad.scene.lights = {viewer::parseLight("area:disk:0,0,0:0,0,-1:0.05:100,100,100")};
  quad.scene.lights[0].position.z = distance;
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.compile();
  quad.bakeOpen(3);
  quad.bake.ch = quad.bake.sh;
  if (withShells) blockFirstShell(quad, blocked);
  return pixelAt(quad.render(squareByBake(shading)));
}

TEST(NearLampShading, AreaLight_IsDarkBehindAndBrightBeforeWhatBlocks) {
  expectColor(diskOver(5.0, 1.0, false), glm::dvec3(100.0 * 0.0025 / (25.0 + 0.0025)), 4e-3);
  expectColor(diskOver(5.0, 1.0, true), glm::dvec3(0), 1e-6);
  expectColor(diskOver(5.0, 1.0, true, Shading::Ch), glm::dvec3(0), 1e-6);
  expectColor(diskOver(0.15, 1.0, true), glm::dvec3(diskOver(0.15, 1.0, false)), 1e-5);
}

TEST(NearLampShading, AreaLightAtAPartOfAShell_IsWhatTheHostFinds) {
  const NearLampTransfer range{1, 2, 0.1, 10.0, {}};
  const double visibility = sharpened(1.0 - 0.7 * shareBefore(range, 0, 2.0));
  ASSERT_LT(visibility, 1.0);
  expectColor(diskOver(2.0, 0.7, true), visibility * glm::dvec3(diskOver(2.0, 0.7, false)), 4e-3);
}

TEST(NearLampShading, SixteenLampsBehindWhatBlocks_AreDark_AndASeventeenthIsNot) {
  for (const int count : {16, 17}) {
    QuadScene quad;
    quad.add(test::lambertian(glm::vec3(1)), 0.02f);
    quad.add(test::lambertian(glm::vec3(1)), 2.0f, glm::translate(glm::dmat4(1.0), {0, 0, 6}));
    quad.lookFrom({0.02, 0, 0.1}, {0, 0, 0});
    for (int i = 0; i < count; ++i)
      quad.scene.lights.push_back(
          test::makeLight(LightType::Point, glm::vec3(i == 2 ? 1.0f : 30.0f), {0, 0, 5}));
    quad.setSky(constantEnvironment(glm::vec3(0)));
    quad.compile();
    quad.bakeOpen(3);
    blockFirstShell(quad, 1.0);
    const float left = count == 17 ? 1.0f / (25.0f * lampPi) : 0.0f;  // Light of the weakest lamp.
    expectColor(pixelAt(quad.render(squareByBake(Shading::Sh))), glm::dvec3(left), 4e-3);
  }
}

viewer::ShadedLight lampAt(const glm::vec3& position) {
  viewer::ShadedLight lamp;
  lamp.position = position;
  return lamp;
}

/// 16 samples of a square of 1 m at `x`.
std::vector<viewer::ShadedLight> panelAt(float x) {
  std::vector<viewer::ShadedLight> samples;
  for (int i = 0; i < 16; ++i) {
    viewer::ShadedLight sample =
        lampAt({x + 0.25f * static_cast<float>(i % 4), 2.0f, 0.25f * static_cast<float>(i / 4)});
    sample.isSample = true;
    sample.area = 1.0f / 16.0f;
    samples.push_back(sample);
  }
  return samples;
}

TEST(NearLampPass, SamplesOfTwoPanels_ShareShadowsWithNeighboursOnly) {
  std::vector<viewer::ShadedLight> lights = {lampAt({0, 0, 0}), lampAt({1, 0, 0})};
  for (const float x : {-5.0f, 5.0f})
    for (const viewer::ShadedLight& sample : panelAt(x)) lights.push_back(sample);
  viewer::NearLampPass::choose(lights, {});
  EXPECT_EQ(lights[0].shadow, 0);
  EXPECT_EQ(lights[1].shadow, 1);
  std::set<int> left, right;
  for (std::size_t i = 2; i < lights.size(); ++i) {
    EXPECT_GE(lights[i].shadow, 2);
    (i < 18 ? left : right).insert(lights[i].shadow);
  }
  EXPECT_EQ(left.size(), 2u);
  EXPECT_EQ(right.size(), 2u);
  for (const int shadow : left) EXPECT_FALSE(right.contains(shadow)) << shadow;
  std::vector<viewer::ShadedLight> draft = {panelAt(5.1f)[3]};
  viewer::NearLampPass::share(lights, draft);
  EXPECT_EQ(draft[0].shadow, lights.back().shadow);
}

TEST(NearLampPass, SamplesThatLieFarApartForTheirSurface_HaveNoShadow) {
  std::vector<viewer::ShadedLight> lights;
  for (int i = 0; i < 32; ++i) {
    viewer::ShadedLight bulb = lampAt({i, 0, 0});
    bulb.isSample = true;
    bulb.area = 0.01f;
    lights.push_back(bulb);
  }
  viewer::NearLampPass::choose(lights, {});
  for (const viewer::ShadedLight& light : lights) EXPECT_LT(light.shadow, 0);
}

TEST(NearLampShading, PhongAndAo_HaveNoShadowsOfShells) {
  const glm::vec3 plain = lampOver(5.0, 1.0, false, Shading::Phong);
  expectColor(lampOver(5.0, 1.0, true, Shading::Phong), glm::dvec3(plain), 1e-6);
}

}  // namespace
}  // namespace prelight
