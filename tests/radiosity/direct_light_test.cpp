#include "radiosity/direct_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/devices.h"
#include "support/profiles.h"
#include "support/scenes.h"

namespace prelight {
namespace {

device::Receiver lookingUp(const glm::vec3& p) {
  return {{p.x, p.y, p.z}, PRELIGHT_NO_TRIANGLE, {0, 1, 0}, 1, {0, 1, 0}, 0};
}

// One float sum of as many equal terms is off by 1e-3: all of them round the same way.
TEST(DirectLight, ThousandsOfEqualLights_AddUp) {
  constexpr std::size_t count = 50000;
  const CompiledScene scene = test::ground(1, 1.0f);
  Light light;
  light.position = {0.0, 1.0, 0.0};
  light.intensity = glm::vec3(1.0f / float(count));
  RadiosityLights lights;
  lights.punctual.assign(count, light);
  Tracer tracer(scene, test::sharedDevice());
  DirectLight direct(scene, tracer);
  direct.setLights(lights);
  const std::array<device::Receiver, 1> places = {lookingUp({0.3f, 1e-3f, 0.2f})};
  const glm::dvec3 way(0.3, 1.0 - 1e-3, 0.2);
  const double expected = double(light.intensity.x) * double(count) * way.y / std::pow(glm::length(way), 3.0);
  EXPECT_NEAR(direct.at(places)[0].far.x / expected, 1.0, 2e-5);
}

TEST(DirectLight, LampWithAProfile_ShinesByIt) {
  const CompiledScene scene = test::ground(1, 9.0f);
  Light lamp = test::profiledLight({0, 2, 0}, test::makeProfile(test::cosineLobe));
  lamp.intensity = glm::vec3(3.0f);
  RadiosityLights lights;
  lights.punctual = {lamp};
  Tracer tracer(scene, test::sharedDevice());
  DirectLight direct(scene, tracer);
  direct.setLights(lights);
  for (const float x : {0.0f, 1.0f, 4.0f}) {
    const std::array<device::Receiver, 1> places = {lookingUp({x, 1e-3f, 0})};
    const double height = 2.0 - 1e-3, cosine = height / std::hypot(double(x), height);
    EXPECT_NEAR(direct.at(places)[0].far.x, 3.0 / (height * height) * std::pow(cosine, 4.0), 3e-4);
  }
}

// As an element's own emission does, wherever on the lamp the texture is bright.
TEST(DirectLight, TexturedLamp_CountsWithItsMean) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}});  // faces down
  const auto lightAt = [&](float mean, float factor) {
    scene.materials[0].emission = glm::vec3(mean);
    scene.materials[0].emissionFactor = glm::vec3(factor);
    Tracer tracer(scene, test::sharedDevice());
    DirectLight direct(scene, tracer);
    direct.setLights({});
    const std::array<device::Receiver, 1> places = {lookingUp({0.3f, -1.0f, 0.3f})};
    return direct.at(places)[0].emitters.x;
  };
  EXPECT_GT(lightAt(2.0f, 2.0f), 0.1f);
  EXPECT_EQ(lightAt(2.0f, 5.0f), lightAt(2.0f, 2.0f));
}

// Far off, the parts of a triangle's edges cancel in Lambert's formula.
TEST(DirectLight, SmallLampFarAside_IsTheInverseSquareLaw) {
  for (const float distance : {10.0f, 40.0f, 1e3f, 1e5f}) {
    CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}});  // faces down
    scene.materials[0].emission = scene.materials[0].emissionFactor = glm::vec3(2.0f);
    Tracer tracer(scene, test::sharedDevice());
    DirectLight direct(scene, tracer);
    direct.setLights({});
    const glm::vec3 place(-1.2f * distance, -distance, 0.4f * distance);
    const std::array<device::Receiver, 1> places = {lookingUp(place)};
    // Over small pieces of the lamp, each of which is far.
    double expected = 0.0;
    constexpr int pieces = 200;
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; j < pieces; ++j) {
        const double x = (i + 0.5) / pieces, z = (j + 0.5) / pieces;
        if (i + j > pieces - 1) continue;
        const double share = i + j == pieces - 1 ? 0.5 : 1.0;
        const glm::dvec3 way = glm::dvec3(x, 0.0, z) - glm::dvec3(place);
        expected += 2.0 * share * way.y * way.y / std::pow(glm::dot(way, way), 2.0) / (pieces * pieces);
      }
    EXPECT_NEAR(direct.at(places)[0].emitters.x / expected, 1.0, 3e-4) << distance;
  }
}

}  // namespace
}  // namespace prelight
