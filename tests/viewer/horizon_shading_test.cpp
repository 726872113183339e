#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "images/sky_lamps.h"
#include "prelight/picture.h"
#include "scene/surface/surface_frame.h"
#include "support/disk_skies.h"
#include "techniques/horizons/horizon_bands.h"
#include "viewer/options/light_option.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::expectColor;
using test::pixelAt;
using test::QuadScene;
using test::squareByBake;
using viewer::Shading;

constexpr auto floatPi = static_cast<float>(std::numbers::pi);
constexpr int sectors = 4;

/// A white quad that faces +Z and the camera.
QuadScene whiteQuad(float metallic = 0.0f) {
  QuadScene quad;
  Material material = test::lambertian(glm::vec3(1));
  material.metallic = metallic;
  if (metallic > 0.0f) material.roughness = 0.05f;
  quad.add(material);
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  return quad;
}

/// Bakes the same horizons at every vertex.
void bakeHorizons(QuadScene& quad, const std::array<float, sectors>& angles, float foot = 0.0f) {
  quad.compile();
  quad.bake.horizons = HorizonTransfer{sectors, {}, {}};
  for (int v = 0; v < 4; ++v)
    quad.bake.horizons->angles.insert(quad.bake.horizons->angles.end(), angles.begin(), angles.end());
  if (foot > 0.0f) quad.bake.horizons->feet.assign(quad.bake.horizons->angles.size(), foot);
}

constexpr std::array<float, sectors> even(float angle) { return {angle, angle, angle, angle}; }

/// Direction to a lamp above the quad, by its elevation from the quad's plane and its azimuth in the frame.
glm::dvec3 wayTo(double turn, double height) {
  const glm::dmat3 frame(surfaceFrame({0, 0, 1}));
  return frame *
         glm::dvec3(std::cos(height) * std::cos(turn), std::cos(height) * std::sin(turn), std::sin(height));
}

/// Radiance under a lamp in that direction, relative to that without shadows.
float shareOfLamp(LightType type, double turn, double height, const std::array<float, sectors>& angles,
                  double softness, bool interpolated = false, float foot = 0.0f) {
  const glm::dvec3 way = wayTo(turn, height);
  const auto draw = [&](const std::array<float, sectors>& horizons, float from) {
    QuadScene quad = whiteQuad();
    Light light = test::makeLight(type, glm::vec3(10.0f * floatPi),
                                  type == LightType::Directional ? glm::dvec3(0.0) : 3.0 * way, -way);
    light.outerConeAngle = 0.5;
    quad.scene.lights = {light};
    quad.setSky(constantEnvironment(glm::vec3(0)));
    bakeHorizons(quad, horizons, from);
    // The other two vertices, on or beside the diagonal through the middle, get 0 and twice the angle.
    if (interpolated)
      for (std::size_t i = 0; i < quad.bake.horizons->angles.size(); ++i)
        quad.bake.horizons->angles[i] *= i / sectors == 0 || i / sectors == 1 ? 2.0f : 0.0f;
    viewer::RenderOptions options = squareByBake(Shading::Horizons);
    options.horizonSoftness = softness;
    return pixelAt(quad.render(options)).r;
  };
  return draw(angles, foot) / draw(even(0.0f), 0.0f);
}

TEST(HorizonShading, EvenSky_IsTheMeanOfOneMinusSquaredSines) {
  QuadScene quad = whiteQuad();
  quad.setSky(constantEnvironment(glm::vec3(2)));
  bakeHorizons(quad, {0.0f, 0.3f, 0.6f, 1.2f});
  double open = 0.0;
  for (const double angle : {0.0, 0.3, 0.6, 1.2}) open += 0.25 * std::pow(std::cos(angle), 2);
  expectColor(pixelAt(quad.render(squareByBake(Shading::Horizons))), glm::dvec3(2.0 * open), 1e-4);
}

TEST(HorizonShading, HorizonOnOneSide_PicksTheOtherSideOfTheSky) {
  const glm::mat3 frame = surfaceFrame({0, 0, 1});
  std::array<float, sectors> angles{};
  for (int s = 0; s < sectors; ++s) {
    const float turn = 0.5f * floatPi * (static_cast<float>(s) + 0.5f);
    angles[s] = frame[0].x * std::cos(turn) + frame[1].x * std::sin(turn) < 0.0f ? 0.5f * floatPi : 0.0f;
  }
  QuadScene quad = whiteQuad();
  quad.setSky(test::halvedSky());
  bakeHorizons(quad, angles);
  const glm::vec3 pixel = pixelAt(quad.render(squareByBake(Shading::Horizons)));
  EXPECT_GT(pixel.r, 2.0f * pixel.g);
}

TEST(HorizonShading, LampsOfEachKind_AreSeenAboveTheirHorizon) {
  for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot})
    for (const double turn : {0.0, 1.0, 2.5, 4.0, 6.0}) {
      EXPECT_NEAR(shareOfLamp(type, turn, 0.75, even(0.7f), 0.0), 1.0f, 1e-4f) << int(type) << " " << turn;
      EXPECT_NEAR(shareOfLamp(type, turn, 0.65, even(0.7f), 0.0), 0.0f, 1e-4f) << int(type) << " " << turn;
    }
}

TEST(HorizonShading, LampTowardsASector_MeetsThatHorizon) {
  const std::array<float, sectors> angles = {0.2f, 0.4f, 0.6f, 0.8f};
  for (const double turn : {0.3, 1.0, 2.0, 3.3, 4.4, 6.1}) {
    const double horizon = horizonTowards(angles, turn);
    EXPECT_NEAR(shareOfLamp(LightType::Directional, turn, horizon + 0.02, angles, 0.0), 1.0f, 1e-4f) << turn;
    EXPECT_NEAR(shareOfLamp(LightType::Directional, turn, horizon - 0.02, angles, 0.0), 0.0f, 1e-4f) << turn;
  }
}

TEST(HorizonShading, SoftLamp_ShowsTheSegmentOfItsDisk) {
  for (const double above : {-0.12, -0.06, 0.0, 0.04, 0.12})
    EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, 0.7 + above, even(0.7f), 0.1),
                diskAboveHorizon(above, 0.1), 2e-3)
        << above;
}

TEST(HorizonShading, BetweenVertices_AnglesAreInterpolated) {
  EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, 0.74, even(0.7f), 0.0, true), 1.0f, 1e-3f);
  EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, 0.66, even(0.7f), 0.0, true), 0.0f, 1e-3f);
}

/// Lamps shine in below a hanging occluder, and none shines through a standing one, however low the lamp is.
TEST(HorizonShading, BandWithAFoot_IsSeenPastBelowAndAbove) {
  constexpr float foot = 0.5f;
  for (const double height : {0.05, 0.3, 0.45, 0.48, 0.5, 0.52, 0.7, 0.98, 1.0, 1.02, 1.3})
    EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, height, even(1.0f), 0.05, false, foot),
                diskPastBand(height, 0.05, 0.5, 1.0), 3e-3)
        << height;
  EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, 0.3, even(1.0f), 0.05, false, foot), 1.0f, 1e-4f);
  EXPECT_NEAR(shareOfLamp(LightType::Directional, 1.3, 0.7, even(1.0f), 0.05, false, foot), 0.0f, 1e-4f);
}

TEST(HorizonShading, AreaLight_IsAsSoftAsItIsLarge) {
  const auto share = [](double height) {
    const auto draw = [&](float horizon) {
      QuadScene quad = whiteQuad();
      const glm::dvec3 place = 3.0 * wayTo(1.3, height);
      quad.scene.lights = {
          viewer::parseLight(fmt::format("area:sphere:{},{},{}:0.3:10,10,10", place.x, place.y, place.z))};
      quad.setSky(constantEnvironment(glm::vec3(0)));
      bakeHorizons(quad, even(horizon));
      viewer::RenderOptions options = squareByBake(Shading::Horizons);
      options.horizonSoftness = 0.0;
      return pixelAt(quad.render(options)).r;
    };
    return draw(0.7f) / draw(0.0f);
  };
  for (const double above : {-0.05, 0.0, 0.05})
    EXPECT_NEAR(share(0.7 + above), diskAboveHorizon(above, std::asin(0.1)), 0.01) << above;
}

/// Below lies what hides the sky, which is as open and reflects half of radiance 2.
TEST(HorizonShading, MirrorThatLooksBelowItsHorizon_ReflectsWhatHidesTheSky) {
  const auto reflected = [](float horizon) {
    QuadScene quad = whiteQuad(1.0f);
    quad.scene.cameras.clear();
    quad.lookFrom(2.0 * wayTo(1.0, 0.7), {0, 0, 0});
    quad.setSky(constantEnvironment(glm::vec3(2)));
    bakeHorizons(quad, even(horizon));
    return pixelAt(quad.render(squareByBake(Shading::Horizons))).r;
  };
  const float open = 1.0f - std::pow(std::sin(0.8f), 2.0f);
  EXPECT_NEAR(reflected(0.8f), 0.5f * open * 2.0f, 2e-3f);
  EXPECT_GT(reflected(0.6f), 1.9f);
}

/// The lamp of a sky is dimmed on a back as the rest of the sky is.
TEST(HorizonShading, LampOfASkyBehindTwoSidedQuad_HasTheAccessibleShare) {
  QuadScene quad;
  Material material = test::lambertian(glm::vec3(1));
  material.doubleSided = true;
  quad.add(material);
  quad.lookFrom({0, 0, -2}, {0, 0, 0});
  const Environment sky = test::skyWithDisk(256, glm::vec3(0.0f), {0.0, 0.0, -1.0}, 0.05, glm::vec3(1000.0f));
  quad.setSky(sky);
  const LampsAndSky parts = takeLampsOut(sky);
  ASSERT_EQ(parts.lamps.size(), 1u);
  bakeHorizons(quad, even(0.3f));
  const double open = std::pow(std::cos(0.3), 2);  // above the horizons, which are those of the front
  const glm::dvec3 expected = open * parts.lamps[0].irradiance / std::numbers::pi;
  expectColor(pixelAt(quad.render(squareByBake(Shading::Horizons))), expected, 0.005 * expected.x);
}

}  // namespace
}  // namespace prelight
