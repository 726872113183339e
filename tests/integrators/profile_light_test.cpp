#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scene/light_profile.h"
#include "support/profiles.h"
#include "support/shot.h"

// Lamps with profiles (EXT_lights_ies), against closed forms.
namespace prelight::test {
namespace {

using reference::Integrator;
using std::numbers::pi;

/// Radiance that a white Lambertian floor sends straight up around `target`.
double radianceAt(const glm::dvec3& target, const Light& light, Integrator integrator = Integrator::Path) {
  Shot shot = shotOf(ground(1, 10.0f), orthographicCamera(target + glm::dvec3(0, 1, 0), target, 1e-3), 2, 32);
  shot.scene.materials[0] = lambert(1.0f);
  shot.lights = {light};
  shot.request.depth = 2;
  shot.request.integrator = integrator;
  return meanOf(shot.render()).mean;
}

TEST(ProfiledLight, CosineAboveAFloor_GivesTheFourthPowerOfTheCosine) {
  Light lamp = profiledLight({0, 2, 0}, makeProfile(cosineLobe));
  lamp.intensity = glm::vec3(7.0f);
  for (const Integrator integrator : {Integrator::Path, Integrator::Whitted, Integrator::Distributed})
    for (const double x : {0.0, 1.0, 3.0}) {
      const double cosine = 2.0 / std::hypot(x, 2.0);
      EXPECT_NEAR(radianceAt({x, 0, 0}, lamp, integrator), 7.0 / (4.0 * pi) * std::pow(cosine, 4.0), 2e-4);
    }
}

TEST(ProfiledLight, Turned_ShinesAsItsFrameTells) {
  const auto profile = makeProfile([](double height, double turn) {
    return 1.0 + std::cos(0.5 * height) * (1.5 + std::sin(turn) + 0.4 * std::cos(2.0 * turn));
  });
  const std::array<glm::dvec3, 3> aims = {glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(1, -1, 0.5)),
                                          glm::dvec3(0, 1, 0)};
  for (const glm::dvec3& aim : aims) {
    const glm::dvec3 side = glm::normalize(glm::cross(aim, glm::dvec3(0.3, 0.2, 1.0)));
    const Light lamp = profiledLight({0.5, 2, 0.25}, profile, aim, side);
    for (const glm::dvec3& target : {glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 1), glm::dvec3(-1, 0, 3)}) {
      const glm::dvec3 way = target - lamp.position, d = glm::normalize(way);
      const double height = std::acos(glm::dot(d, aim));
      const double turn = std::atan2(glm::dot(d, glm::cross(-aim, side)), glm::dot(d, side));
      const double intensity =
          1.0 + std::cos(0.5 * height) * (1.5 + std::sin(turn) + 0.4 * std::cos(2.0 * turn));
      EXPECT_NEAR(profileTowards(lamp, d), intensity, 4e-3);
      const double expected = profileTowards(lamp, d) / pi * -d.y / glm::dot(way, way);
      EXPECT_NEAR(radianceAt(target, lamp), expected, 3e-4 * expected);
    }
  }
}

TEST(ProfiledLight, OutsideItsAngles_IsDark) {
  auto profile = std::make_shared<LightProfile>();
  profile->heights = {0.2, 0.8};
  profile->turns = {0.5, 1.0, 2.0};
  profile->values = {3, 3, 3, 3, 3, 3};
  const auto at = [&](double height, double turn) {
    // The lamp's X axis is the world's, its Y axis is -Z.
    const double out = 2.0 * std::tan(height);
    return radianceAt({out * std::cos(turn), 0, -out * std::sin(turn)}, profiledLight({0, 2, 0}, profile));
  };
  for (const auto& [height, turn] : {std::pair(0.25, 0.55), std::pair(0.75, 1.95)})
    EXPECT_NEAR(at(height, turn), 0.75 / pi * std::pow(std::cos(height), 3.0), 1e-4);
  EXPECT_EQ(at(0.15, 1.0), 0.0);
  EXPECT_EQ(at(0.85, 1.0), 0.0);
  EXPECT_EQ(at(0.5, 0.4), 0.0);
  EXPECT_EQ(at(0.5, 2.1), 0.0);
  EXPECT_EQ(at(0.5, 4.0), 0.0);
}

}  // namespace
}  // namespace prelight::test
