#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "images/sky_lamps.h"
#include "prelight/picture.h"
#include "support/disk_skies.h"
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

/// A white quad that faces +Z and the camera.
QuadScene whiteQuad() {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  return quad;
}

/// Bakes the same cone at every vertex.
void bakeCone(QuadScene& quad, const glm::vec3& axis, float aperture, float accessibility) {
  quad.compile();
  quad.bakeOpen(2, 1, accessibility);
  quad.bake.bentNormals.assign(4, axis);
  quad.bake.apertures.assign(4, aperture);
}

glm::vec3 underLamp(const glm::vec3& axis, float aperture, const glm::dvec3& fromLamp) {
  QuadScene quad = whiteQuad();
  quad.scene.lights = {test::makeLight(LightType::Directional, glm::vec3(floatPi), {}, fromLamp)};
  quad.setSky(constantEnvironment(glm::vec3(0)));
  bakeCone(quad, axis, aperture, 0.25f);
  return pixelAt(quad.render(squareByBake(Shading::Cones)));
}

TEST(ConeShading, EvenSky_IsTheAccessibilityWhateverTheCone) {
  for (const float aperture : {0.0f, 0.5f, 0.95f}) {
    QuadScene quad = whiteQuad();
    quad.setSky(constantEnvironment(glm::vec3(2)));
    bakeCone(quad, {0.6f, 0, 0.8f}, aperture, 0.3f);
    expectColor(pixelAt(quad.render(squareByBake(Shading::Cones))), glm::dvec3(0.6), 1e-4);
  }
}

TEST(ConeShading, LampInTheCone_IsNotShadowed) {
  expectColor(underLamp({0, 0, 1}, 0.5f, {0, 0, -1}), glm::dvec3(1), 1e-4);
}

TEST(ConeShading, LampOutsideTheCone_IsShadowed) {
  const glm::dvec3 aslant = glm::normalize(glm::dvec3(-1, 0, -0.3));
  expectColor(underLamp({0, 0, 1}, 0.9f, aslant), glm::dvec3(0), 1e-6);
  EXPECT_GT(underLamp(glm::normalize(glm::vec3(1, 0, 0.3f)), 0.7f, aslant).r, 0.25f)
      << "the cone looks that way";
}

/// The lamp of a sky is dimmed on a back as the rest of the sky is.
TEST(ConeShading, LampOfASkyBehindTwoSidedQuad_HasTheAccessibleShare) {
  QuadScene quad;
  Material material = test::lambertian(glm::vec3(1));
  material.doubleSided = true;
  quad.add(material);
  quad.lookFrom({0, 0, -2}, {0, 0, 0});
  const Environment sky = test::skyWithDisk(256, glm::vec3(0.0f), {0.0, 0.0, -1.0}, 0.05, glm::vec3(1000.0f));
  quad.setSky(sky);
  const LampsAndSky parts = takeLampsOut(sky);
  ASSERT_EQ(parts.lamps.size(), 1u);
  bakeCone(quad, {0, 0, 1}, 0.5f, 0.25f);
  const glm::dvec3 expected = 0.25 * parts.lamps[0].irradiance / std::numbers::pi;
  expectColor(pixelAt(quad.render(squareByBake(Shading::Cones))), expected, 0.005 * expected.x);
}

/// Share of a cap's solid angle within a cone, by points on the cap. Angles are in radians.
double shareInCone(double capRadius, double coneRadius, double apart) {
  constexpr int rings = 200, turns = 400;
  int inside = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const double height = 1.0 - (i + 0.5) / rings * (1.0 - std::cos(capRadius));
      const double out = std::sqrt(1.0 - height * height), turn = 2.0 * std::numbers::pi * (j + 0.5) / turns;
      // The centre of the cap is +Z; the cone's axis is in the plane of X and Z.
      inside += out * std::cos(turn) * std::sin(apart) + height * std::cos(apart) > std::cos(coneRadius);
    }
  return static_cast<double>(inside) / (rings * turns);
}

/// Share of a ball's light that an open place keeps with a cone whose axis is `apart` from the quad's normal.
double shareOfBall(double ballRadius, double coneRadius, double apart) {
  const auto draw = [&](const glm::vec3& axis, double cone) {
    QuadScene quad = whiteQuad();
    quad.scene.lights = {
        viewer::parseLight(fmt::format("area:sphere:0,0,3:{}:1,1,1", 3.0 * std::sin(ballRadius)))};
    quad.setSky(constantEnvironment(glm::vec3(0)));
    bakeCone(quad, axis, static_cast<float>(std::cos(cone)), 1.0f);
    return pixelAt(quad.render(squareByBake(Shading::Cones))).r;
  };
  return draw({std::sin(apart), 0.0, std::cos(apart)}, coneRadius) / draw({0, 0, 1}, 0.5 * std::numbers::pi);
}

/// The cone cuts the disk of a light's directions (Oat and Sander, "Ambient aperture lighting", 2007).
TEST(ConeShading, LargeLamp_IsSeenAsFarAsItLiesInTheCone) {
  for (const double ball : {0.15, 0.5, 0.9})
    for (const double cone : {0.3, 0.7, 1.2})
      for (const double apart : {0.0, 0.3, 0.6, 0.9, 1.2, 1.5})
        EXPECT_NEAR(shareOfBall(ball, cone, apart), shareInCone(ball, cone, apart), 0.08)
            << ball << " " << cone << " " << apart;
}

/// The centre of a lamp above a wall may be hidden while half of the lamp is visible.
TEST(ConeShading, LampWhoseMiddleIsOutsideTheCone_IsNotAllInShadow) {
  EXPECT_NEAR(shareOfBall(0.6, 0.5, 0.55), shareInCone(0.6, 0.5, 0.55), 0.08);
  EXPECT_GT(shareOfBall(0.6, 0.5, 0.55), 0.25);
}

/// A sun of one degree, and a sky of radiance 0.2 around it.
Environment skyWithSun(const glm::dvec3& towards, double irradiance) {
  Environment sky{512, 256, {}};
  double solidAngle = 0.0;
  std::vector<std::size_t> disk;
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 way = Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
      sky.radiance.emplace_back(0.2f);
      if (glm::dot(way, towards) < std::cos(1.0 * std::numbers::pi / 180.0)) continue;
      disk.push_back(sky.radiance.size() - 1);
      solidAngle += std::sin(std::numbers::pi * (row + 0.5) / sky.height) * 2.0 *
                    std::pow(std::numbers::pi, 2) / (sky.width * sky.height);
    }
  for (const std::size_t texel : disk) sky.radiance[texel] += static_cast<float>(irradiance / solidAngle);
  return sky;
}

/// The sun within a sky shines where the cone is open towards it.
TEST(ConeShading, SunOfASky_ShinesIntoItsConeAlone) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.6, 0.0, 0.8));
  const auto draw = [&](const glm::vec3& axis) {
    QuadScene quad = whiteQuad();
    quad.setSky(skyWithSun(sun, 3.0));
    bakeCone(quad, axis, 0.9f, 0.19f);
    return pixelAt(quad.render(squareByBake(Shading::Cones))).r;
  };
  EXPECT_NEAR(draw({0.6f, 0.0f, 0.8f}), 3.0 * 0.8 / std::numbers::pi + 0.19 * 0.2, 0.02);
  EXPECT_NEAR(draw({-0.6f, 0.0f, 0.8f}), 0.19 * 0.2, 1e-3);
}

/// Turning the sky turns its sun.
TEST(ConeShading, SunOfATurnedSky_IsTurned) {
  QuadScene quad = whiteQuad();
  quad.setSky(skyWithSun({1.0, 0.0, 0.0}, 3.0));
  bakeCone(quad, {0.0f, 0.0f, 1.0f}, 0.9f, 0.19f);
  viewer::RenderOptions options = squareByBake(Shading::Cones);
  options.skyRotation = -0.5 * std::numbers::pi;  // From +X to +Z.
  EXPECT_NEAR(pixelAt(quad.render(options)).r, 3.0 / std::numbers::pi + 0.19 * 0.2, 0.02);
}

/// A mirror shows the sun once: as part of the map, and not as a lamp in addition.
TEST(ConeShading, MetalUnderASun_ReflectsItOnce) {
  const auto reflected = [](Shading shading) {
    QuadScene quad;
    Material metal = test::lambertian(glm::vec3(1));
    metal.metallic = 1.0f;
    metal.roughness = 0.5f;
    quad.add(metal);
    quad.lookFrom({0, 0, 2}, {0, 0, 0});
    quad.setSky(skyWithSun({0.0, 0.0, 1.0}, 3.0));
    bakeCone(quad, {0.0f, 0.0f, 1.0f}, 0.0f, 1.0f);
    return pixelAt(quad.render(squareByBake(shading))).r;
  };
  EXPECT_NEAR(reflected(Shading::Cones), reflected(Shading::Ao), 1e-3 * reflected(Shading::Ao));
}

TEST(ConeShading, NarrowCone_PicksItsSideOfTheSky) {
  for (const float aperture : {0.3f, 0.95f}) {
    QuadScene quad = whiteQuad();
    quad.setSky(test::halvedSky());
    bakeCone(quad, {1, 0, 0}, aperture, 1.0f);
    const glm::vec3 pixel = pixelAt(quad.render(squareByBake(Shading::Cones)));
    EXPECT_GT(pixel.r, 0.9f) << aperture;
    EXPECT_LT(pixel.g, 0.1f) << aperture;
  }
}

/// Surroundings that hide the sky are taken to be as open as the vertex and to reflect half: their radiance
/// is 0.3 / 2 of the sky's, which is 2.
TEST(ConeShading, MirrorThatLooksOutOfItsCone_ReflectsWhatHidesTheSky) {
  const auto reflected = [](const glm::vec3& axis, float aperture) {
    QuadScene quad;
    Material mirror = test::lambertian(glm::vec3(1));
    mirror.metallic = 1.0f;
    mirror.roughness = 0.05f;
    quad.add(mirror);
    quad.lookFrom({0, 0, 2}, {0, 0, 0});
    quad.setSky(constantEnvironment(glm::vec3(2)));
    bakeCone(quad, axis, aperture, 0.3f);
    return pixelAt(quad.render(squareByBake(Shading::Cones)));
  };
  EXPECT_NEAR(reflected(glm::normalize(glm::vec3(1, 0, 0.2f)), 0.9f).r, 0.5f * 0.3f * 2.0f, 1e-3f);
  EXPECT_GT(reflected({0, 0, 1}, 0.9f).r, 1.9f);
}

}  // namespace
}  // namespace prelight
