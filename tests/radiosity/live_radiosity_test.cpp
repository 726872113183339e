#include "radiosity/live_radiosity.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "prelight/error.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using Irradiance = std::vector<glm::vec3>;

Light lampAt(const glm::dvec3& position) {
  Light light;
  light.intensity = {8, 6, 4};
  light.position = position;
  return light;
}

/// A closed room of 4 x 3 x 5 m with a block in it.
CompiledScene furnishedRoom(int cells) {
  CompiledScene scene = test::box(cells, {0, 0, 0}, {4, 3, 5}, true);
  test::append(scene, test::box(cells, {1.2f, 0.0f, 1.5f}, {2.1f, 1.4f, 2.6f}, false));
  scene.materials[0].albedo = glm::vec3(0.6f, 0.5f, 0.4f);
  return scene;
}

BakeRequest radiosityRequest() {
  BakeRequest request;
  request.radiosity.wanted = true;
  request.effort.rays = 256;
  return request;
}

Irradiance bakedUnder(CompiledScene scene, const std::vector<Light>& lights) {
  scene.lights = lights;
  return *test::runBake(scene, radiosityRequest()).bake.irradiance;
}

/// RMS of the difference over RMS of the second.
double relativeDifference(const Irradiance& a, const Irradiance& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t v = 0; v < b.size(); ++v) {
    const glm::dvec3 d = glm::dvec3(a[v]) - glm::dvec3(b[v]);
    difference += glm::dot(d, d);
    size += glm::dot(glm::dvec3(b[v]), glm::dvec3(b[v]));
  }
  return std::sqrt(difference / size);
}

Irradiance settled(LiveRadiosity& live) {
  live.wait();
  auto found = live.take();
  EXPECT_TRUE(found.has_value());
  return found.value_or(Irradiance());
}

TEST(LiveRadiosity, BeforeLightsCome_ComputesNothing) {
  const CompiledScene scene = furnishedRoom(2);
  LiveRadiosity live(scene, radiosityRequest(), {});
  live.wait();
  EXPECT_FALSE(live.isBusy());
  EXPECT_FALSE(live.take().has_value());
  EXPECT_EQ(live.formFactorRays(), 0u);
}

TEST(LiveRadiosity, LampThatMoves_IsABakeWithTheLampThere_AndCastsNoFormFactorAnew) {
  const CompiledScene scene = furnishedRoom(6);
  LiveRadiosity live(scene, radiosityRequest(), {});
  const std::vector<Light> before = {lampAt({0.6, 2.5, 0.8})}, after = {lampAt({3.2, 0.9, 4.1})};
  live.setLights({before, nullptr, 0.0});
  const Irradiance first = settled(live);
  const std::uint64_t rays = live.formFactorRays();
  EXPECT_GT(rays, 0u);
  live.setLights({after, nullptr, 0.0});
  const Irradiance moved = settled(live);
  EXPECT_EQ(live.formFactorRays(), rays);
  EXPECT_GT(relativeDifference(moved, first), 0.5);
  EXPECT_LT(relativeDifference(first, bakedUnder(scene, before)), 1e-4);
  EXPECT_LT(relativeDifference(moved, bakedUnder(scene, after)), 1e-4);
}

TEST(LiveRadiosity, AddedAndSwitchedOffLamps_AreBakesWithThem) {
  const CompiledScene scene = furnishedRoom(4);
  LiveRadiosity live(scene, radiosityRequest(), {});
  std::vector<Light> lights = {lampAt({0.6, 2.5, 0.8})};
  live.setLights({lights, nullptr, 0.0});
  live.wait();
  lights.push_back(lampAt({3.5, 1.5, 4.5}));
  live.setLights({lights, nullptr, 0.0});
  EXPECT_LT(relativeDifference(settled(live), bakedUnder(scene, lights)), 1e-4);
  live.setLights({{}, nullptr, 0.0});
  for (const glm::vec3& value : settled(live)) EXPECT_EQ(value, glm::vec3(0.0f));
}

TEST(LiveRadiosity, LampBesideGlowingWalls_LeavesTheirLightAsABakeHasIt) {
  CompiledScene scene = furnishedRoom(4);
  CompiledMaterial glowing = scene.materials[0];
  glowing.emission = {2, 1, 1};
  scene.materials.push_back(glowing);
  for (std::uint32_t t = 0; t < 8; ++t) scene.triangleMaterials[t] = 1;
  LiveRadiosity live(scene, radiosityRequest(), {});
  for (const glm::dvec3& place : {glm::dvec3(0.6, 2.5, 0.8), glm::dvec3(3.2, 0.9, 4.1)}) {
    live.setLights({{lampAt(place)}, nullptr, 0.0});
    EXPECT_LT(relativeDifference(settled(live), bakedUnder(scene, {lampAt(place)})), 1e-4);
  }
}

/// A room with two lamps and glowing walls.
struct GroupedRoom {
  CompiledScene scene = furnishedRoom(4);
  RadiosityLights lights{{lampAt({0.6, 2.5, 0.8}), lampAt({3.2, 0.9, 4.1})}, nullptr, 0.0};
  RadiosityGroups groups{lights, true};

  GroupedRoom() {
    CompiledMaterial glowing = scene.materials[0];
    glowing.emission = {2, 1, 1};
    scene.materials.push_back(glowing);
    for (std::uint32_t t = 0; t < 8; ++t) scene.triangleMaterials[t] = 1;
  }
};

TEST(LiveRadiosity, FactorsOfGroups_AreABakeOfLightsOfThatBrightness_WithoutASolve) {
  GroupedRoom room;
  ASSERT_EQ(room.groups.names(),
            (std::vector<std::string>{"light 0", "light 1", "emissive surfaces", "added lights"}));
  LiveRadiosity live(room.scene, radiosityRequest(), {});
  live.setGroups(room.groups.deal(room.lights));
  live.wait();
  const auto groups = live.takeGroups();
  ASSERT_TRUE(groups.has_value());
  EXPECT_EQ(live.solves(), 4u);
  const std::vector<glm::vec3> factors = {
      glm::vec3(3.0f), {0.0f, 0.5f, 1.0f}, glm::vec3(0.25f), glm::vec3(1.0f)};
  std::vector<Light> lights = room.lights.punctual;
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].intensity *= factors[i];
  CompiledMaterial& glowing = room.scene.materials.back();
  glowing.emission *= factors[2];
  const Irradiance baked = bakedUnder(room.scene, lights);
  EXPECT_LT(relativeDifference(irradianceOf(*groups, factors), baked), 1e-4);
  EXPECT_GT(relativeDifference(irradianceOf(*groups, std::vector<glm::vec3>(4, glm::vec3(1.0f))), baked),
            0.1);
}

TEST(LiveRadiosity, DraggedLampOfAGroup_HasThatGroupAloneSolved) {
  GroupedRoom room;
  LiveRadiosity live(room.scene, radiosityRequest(), {});
  live.setGroups(room.groups.deal(room.lights));
  live.wait();
  const std::uint64_t solves = live.solves(), rays = live.formFactorRays();
  room.lights.punctual[1].position = {2.5, 2.0, 4.0};
  live.setGroups(room.groups.deal(room.lights));
  const Irradiance moved = settled(live);
  EXPECT_LE(live.solves() - solves, 2u) << "a first picture and a last";
  EXPECT_EQ(live.formFactorRays(), rays);
  EXPECT_LT(relativeDifference(moved, bakedUnder(room.scene, room.lights.punctual)), 1e-4);
  live.setGroups(room.groups.deal(room.lights));
  live.wait();
  EXPECT_LE(live.solves() - solves, 2u) << "nothing has changed";
}

TEST(LiveRadiosity, LightsInQuickSuccession_EndAtTheLast) {
  const CompiledScene scene = furnishedRoom(4);
  LiveRadiosity live(scene, radiosityRequest(), {});
  for (int i = 0; i < 50; ++i) live.setLights({{lampAt({0.5 + 0.05 * i, 2.5, 0.8})}, nullptr, 0.0});
  const std::vector<Light> last = {lampAt({2.5, 2.0, 4.0})};
  live.setLights({last, nullptr, 0.0});
  EXPECT_LT(relativeDifference(settled(live), bakedUnder(scene, last)), 1e-4);
}

TEST(LiveRadiosity, DestroyedAtWork_GivesItUp) {
  const CompiledScene scene = furnishedRoom(60);
  BakeRequest request = radiosityRequest();
  request.effort.rays = 16384;  // Takes minutes.
  const auto start = std::chrono::steady_clock::now();
  {
    LiveRadiosity live(scene, request, {});
    live.setLights({{lampAt({0.6, 2.5, 0.8})}, nullptr, 0.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_TRUE(live.isBusy());
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(LiveRadiosity, MemoryThatHoldsNoFormFactors_IsRefusedAtOnce) {
  const CompiledScene scene = furnishedRoom(40);
  BakeRequest request = radiosityRequest();
  request.maxMemory = 1 << 16;
  EXPECT_THROW(LiveRadiosity(scene, request, {}), Error);
}

}  // namespace
}  // namespace prelight
