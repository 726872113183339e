#include "radiosity/direct_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/devices.h"
#include "support/profiles.h"
#include "support/scenes.h"
#include "support/screen_scene.h"

namespace prelight {
namespace {

device::Receiver lookingUp(const glm::vec3& p) {
  return {{p.x, p.y, p.z}, PRELIGHT_NO_TRIANGLE, {0, 1, 0}, 1, {0, 1, 0}, 0};
}

// A single float sum of so many equal terms would be off by 1e-3, because all of them round the same way.
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

/// Emission at a share of the width of a screen of 64 texels whose left quarter is lit. It is interpolated
/// linearly between texel centres, across the edge of the image as well, because the image repeats.
double shownAt(double share) {
  const double column = 64.0 * share - 0.5, low = std::floor(column);
  const auto lit = [](double texel) { return std::fmod(texel + 64.0, 64.0) < 16.0 ? 1.0 : 0.0; };
  return std::lerp(lit(low), lit(low + 1.0), column - low);
}

/// Irradiance from that screen by the midpoint rule.
double litBy(const glm::dvec3& point) {
  double sum = 0.0;
  constexpr int columns = 2048, rows = 100;
  for (int i = 0; i < columns; ++i) {
    const double share = (i + 0.5) / columns, shown = shownAt(share);
    for (int j = 0; j < rows && shown > 0.0; ++j) {
      const glm::dvec3 way = glm::dvec3(2.0 * share - 1.0, 2.0, (j + 0.5) / rows - 0.5) - point;
      sum += shown * way.y * way.y / std::pow(glm::dot(way, way), 2.0) * 2.0 / (columns * rows);
    }
  }
  return double(test::screenRadiance) * sum;
}

// Points below the screen, where few of its lit parts are near, and far to the side.
TEST(DirectLight, ScreenLitInItsLeftQuarter_LightsFromThere) {
  const CompiledScene scene = test::compiledOf(test::screenScene(test::leftQuarter(64, 32)));
  Tracer tracer(scene, test::sharedDevice());
  DirectLight direct(scene, tracer);
  direct.setLights({});
  for (const float x : {-0.75f, 0.75f, 3.0f}) {
    const glm::vec3 place = glm::vec3(x, 1.2f, 0.1f) - glm::vec3(scene.origin);
    std::vector<device::Receiver> receivers(256, lookingUp(place));
    for (std::uint32_t i = 0; i < receivers.size(); ++i) receivers[i].firstSample = i;
    double mean = 0.0;
    for (const PointIrradiance& light : direct.at(receivers)) mean += double(light.emitters.x) / 256.0;
    EXPECT_NEAR(mean / litBy({x, 1.2, 0.1}), 1.0, 0.02) << x;
  }
}

TEST(DirectLight, LampOfAnAtlas_LightsAsIfItHadAMaterialOfItsOwn) {
  const Scene atlas = test::atlasScene();
  Scene apart = atlas;
  apart.materials.push_back(apart.materials[0]);
  apart.materials[0].emission = glm::vec3(0.0f);
  apart.materials[1].emissiveTexture.image = -1;
  apart.meshes.back().primitives[0].material = 1;
  const auto lightIn = [](const CompiledScene& scene) {
    Tracer tracer(scene, test::sharedDevice());
    DirectLight direct(scene, tracer);
    direct.setLights({});
    const glm::vec3 place = glm::vec3(0.4f, 0.01f, -0.3f) - glm::vec3(scene.origin);
    return direct.at(std::vector<device::Receiver>(1, lookingUp(place)))[0].emitters.x;
  };
  const float expected = lightIn(test::compiledOf(apart));
  EXPECT_GT(expected, 0.5f);
  EXPECT_NEAR(lightIn(test::compiledOf(atlas)), expected, 1e-5f * expected);
}

// Far away, the edges' contributions to Lambert's formula cancel almost completely.
TEST(DirectLight, SmallLampFarAside_IsTheInverseSquareLaw) {
  for (const float distance : {10.0f, 40.0f, 1e3f, 1e5f}) {
    CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}});  // Faces down.
    scene.materials[0].emission = glm::vec3(2.0f);
    Tracer tracer(scene, test::sharedDevice());
    DirectLight direct(scene, tracer);
    direct.setLights({});
    const glm::vec3 place(-1.2f * distance, -distance, 0.4f * distance);
    const std::array<device::Receiver, 1> places = {lookingUp(place)};
    // Sums over small pieces of the lamp, each of which is far away.
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
