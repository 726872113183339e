#include <gtest/gtest.h>

#include <numbers>

#include "prelight/picture.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::expectColor;
using test::pixelAt;
using test::QuadScene;
using test::square;
using viewer::Shading;

constexpr auto floatPi = static_cast<float>(std::numbers::pi);

/// A white quad that faces +Z and the camera.
QuadScene whiteQuad() {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  return quad;
}

/// The same cone everywhere.
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
  return pixelAt(quad.render(square(Shading::Cones)));
}

TEST(ConeShading, EvenSky_IsTheAccessibilityWhateverTheCone) {
  for (const float aperture : {0.0f, 0.5f, 0.95f}) {
    QuadScene quad = whiteQuad();
    quad.setSky(constantEnvironment(glm::vec3(2)));
    bakeCone(quad, {0.6f, 0, 0.8f}, aperture, 0.3f);
    expectColor(pixelAt(quad.render(square(Shading::Cones))), glm::dvec3(0.6), 1e-4);
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

TEST(ConeShading, NarrowCone_PicksItsSideOfTheSky) {
  for (const float aperture : {0.3f, 0.95f}) {
    QuadScene quad = whiteQuad();
    quad.setSky(test::halvedSky());
    bakeCone(quad, {1, 0, 0}, aperture, 1.0f);
    const glm::vec3 pixel = pixelAt(quad.render(square(Shading::Cones)));
    EXPECT_GT(pixel.r, 0.9f) << aperture;
    EXPECT_LT(pixel.g, 0.1f) << aperture;
  }
}

TEST(ConeShading, MirrorThatLooksOutOfItsCone_ReflectsNoSky) {
  const auto reflected = [](const glm::vec3& axis, float aperture) {
    QuadScene quad;
    Material mirror = test::lambertian(glm::vec3(1));
    mirror.metallic = 1.0f;
    mirror.roughness = 0.05f;
    quad.add(mirror);
    quad.lookFrom({0, 0, 2}, {0, 0, 0});
    quad.setSky(constantEnvironment(glm::vec3(2)));
    bakeCone(quad, axis, aperture, 0.3f);
    return pixelAt(quad.render(square(Shading::Cones)));
  };
  EXPECT_LT(reflected(glm::normalize(glm::vec3(1, 0, 0.2f)), 0.9f).r, 1e-4f);
  EXPECT_GT(reflected({0, 0, 1}, 0.9f).r, 1.9f);
}

}  // namespace
}  // namespace prelight
