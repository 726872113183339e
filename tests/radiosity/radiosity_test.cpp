#include "radiosity/radiosity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prelight/error.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

Light pointLight(const glm::vec3& intensity, const glm::dvec3& position) {
  Light light;
  light.intensity = intensity;
  light.position = position;
  return light;
}

void setEmission(CompiledScene& scene, std::size_t material, const glm::vec3& radiance) {
  scene.materials[material].emission = radiance;
}

CompiledScene facingPlate(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  return test::sceneOf({corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2}, {0, 2, 3}});
}

std::vector<glm::vec4> elementsOf(const CompiledScene& scene, const RadiosityLights& lights,
                                  RadiosityOptions options = {}) {
  Tracer tracer(scene, test::sharedDevice());
  Radiosity radiosity(scene, tracer, options);
  Progress progress;
  radiosity.cast(progress);
  EXPECT_TRUE(radiosity.relight(lights, progress).converged);
  return radiosity.irradianceOfElements();
}

TEST(Radiosity, PointLightAboveBlackGround_IsTheInverseSquareLaw) {
  CompiledScene scene = test::ground(40, 1.0f);
  scene.materials[0].albedo = glm::vec3(0.0f);
  scene.lights = {pointLight({5, 3, 1}, {0, 1, 0})};
  BakeRequest request;
  request.radiosity.wanted = true;
  const Bake bake = test::runBake(scene, request).bake;
  ASSERT_TRUE(bake.irradiance);
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const double r2 = glm::dot(scene.positions[v], scene.positions[v]) + 1.0;
    const double expected = 1.0 / (r2 * std::sqrt(r2));
    EXPECT_NEAR((*bake.irradiance)[v].x, 5.0 * expected, 0.008) << v;
    EXPECT_NEAR((*bake.irradiance)[v].z, expected, 0.0016) << v;
  }
}

TEST(Radiosity, FurnaceOfManyEmitters_IsExactToo) {
  // The furnace again, with more emissive triangles than are integrated one by one.
  CompiledScene scene = test::box(6, {-1, -1, -1}, {2, 1, 1}, true);
  scene.materials[0].albedo = glm::vec3(0.5f);
  setEmission(scene, 0, {1, 2, 0});
  const std::vector<glm::vec4> e = elementsOf(scene, {});
  for (const glm::vec4& value : e) {
    ASSERT_NEAR(value.x / (2.0 * pi), 1.0, 2e-3);
    ASSERT_NEAR(value.y / (4.0 * pi), 1.0, 2e-3);
    ASSERT_EQ(value.z, 0.0f);
  }
}

TEST(Radiosity, AreaLightOppositeAPlate_IsTheFormFactor) {
  // Parallel unit squares at distance 1 have F = 0.19982, so E = pi L F. The lamp is black.
  CompiledScene scene = facingPlate({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  test::append(scene, facingPlate({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
  scene.materials[0].albedo = scene.materials[1].albedo = glm::vec3(0.0f);
  setEmission(scene, 1, {4, 2, 1});
  const std::vector<glm::vec4> e = elementsOf(scene, {});
  double sum = 0.0;
  for (std::size_t i = 0; i < e.size() / 2; ++i) sum += e[i].x;
  EXPECT_NEAR(sum / double(e.size() / 2) / (4.0 * pi * 0.199825), 1.0, 2e-3);
}

TEST(Radiosity, FurnaceRoom_IsExact) {
  // The walls have albedo 1/2 and emit 1 everywhere: E = pi / (1 - 1/2).
  CompiledScene scene = test::box(2, {-1, -1, -1}, {2, 1, 1}, true);
  scene.materials[0].albedo = glm::vec3(0.5f);
  setEmission(scene, 0, glm::vec3(1.0f));
  BakeRequest request;
  request.radiosity.wanted = true;
  request.radiosity.tolerance = 1e-6;
  const Bake bake = test::runBake(scene, request).bake;
  for (const glm::vec3& e : *bake.irradiance) ASSERT_NEAR(e.x / (2.0 * pi), 1.0, 2e-3);
}

TEST(Radiosity, ObjectUnderAnEvenSky_IsExact) {
  CompiledScene scene = test::sphere(12, 1.0f, {0, 0, 0});
  scene.materials[0].albedo = glm::vec3(0.5f);
  const Environment sky = constantEnvironment({1, 2, 3});
  RadiosityLights lights;
  lights.sky = &sky;
  const std::vector<glm::vec4> e = elementsOf(scene, lights);
  glm::dvec3 mean(0.0);
  for (const glm::vec4& value : e) mean += glm::dvec3(value) / double(e.size());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / (pi * (c + 1)), 1.0, 2e-3);
}

TEST(Radiosity, WhiteRoomUnderAWindow_KeepsItsEnergy) {
  // A room that is open at the top under an even sky is a furnace if its albedo is 1: E = pi L.
  CompiledScene scene = test::box(1, {0, 0, 0}, {2, 1, 2}, true);
  std::erase_if(scene.triangles, [&](const glm::uvec3& t) {
    return scene.positions[t.x].y + scene.positions[t.y].y + scene.positions[t.z].y > 2.9f;
  });
  scene = test::sceneOf(scene.positions, scene.triangles, 0.999f);
  const Environment sky = constantEnvironment(glm::vec3(1.0f));
  RadiosityLights lights;
  lights.sky = &sky;
  RadiosityOptions options;
  options.tolerance = 1e-6;
  const std::vector<glm::vec4> e = elementsOf(scene, lights, options);
  double mean = 0.0;
  for (const glm::vec4& value : e) mean += value.x / double(e.size());
  EXPECT_NEAR(mean / pi, 1.0, 5e-3);
}

TEST(Radiosity, LightThatMoves_FindsNoFormFactorAnew) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  scene.materials[0].albedo = glm::vec3(0.7f);
  Tracer tracer(scene, test::sharedDevice());
  Radiosity moved(scene, tracer, {});
  Progress progress;
  moved.cast(progress);
  const std::uint64_t castRays = moved.report().castRays;
  RadiosityLights lights;
  lights.punctual = {pointLight({5, 5, 5}, {1, 1, 1})};
  moved.relight(lights, progress);
  const std::uint64_t directRays = moved.report().directRays;
  lights.punctual = {pointLight({5, 5, 5}, {3, 2, 4})};
  moved.relight(lights, progress);
  EXPECT_EQ(moved.report().castRays, castRays);
  EXPECT_EQ(moved.report().directRays, 2 * directRays);
  Radiosity anew(scene, tracer, {});
  anew.cast(progress);
  anew.relight(lights, progress);
  const std::vector<glm::vec4> a = moved.irradianceOfElements(), b = anew.irradianceOfElements();
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i].x, b[i].x, 1e-3 * b[i].x + 1e-4);
}

TEST(Radiosity, LightBehindAWall_StaysThere) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {2, 2, 2}, true);
  test::append(scene, test::box(1, {2.1f, 0, 0}, {4, 2, 2}, true));
  scene.materials[0].albedo = scene.materials[1].albedo = glm::vec3(0.6f);
  scene.lights = {pointLight({5, 5, 5}, {1, 1, 1})};
  BakeRequest request;
  request.radiosity.wanted = true;
  const Bake bake = test::runBake(scene, request).bake;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    const float light = (*bake.irradiance)[v].x;
    EXPECT_TRUE(v < scene.vertexCount() / 2 ? light > 1.0f : light == 0.0f) << v << ": " << light;
  }
}

TEST(Radiosity, PlaceInsideAnObject_DoesNotDarkenItsSurroundings) {
  // A crate stands on a floor without shadowing the floor around it.
  CompiledScene scene = test::ground(8, 2.0f);
  test::append(scene, test::box(1, {-0.6f, -0.01f, -0.6f}, {0.6f, 1.0f, 0.6f}, false));
  scene.materials[0].albedo = scene.materials[1].albedo = glm::vec3(0.0f);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0, -1, 0};
  sun.intensity = {2, 2, 2};
  scene.lights = {sun};
  BakeRequest request;
  request.radiosity.wanted = true;
  const Bake bake = test::runBake(scene, request).bake;
  for (std::size_t v = 0; v < 81; ++v) {
    const glm::vec3 p = scene.positions[v];
    if (std::max(std::abs(p.x), std::abs(p.z)) > 0.9f) {
      EXPECT_NEAR((*bake.irradiance)[v].x, 2.0f, 0.02f) << v;
    }
  }
}

TEST(RadiosityBake, NothingShines_IsDarknessWithoutRays) {
  const CompiledScene scene = test::box(1, {0, 0, 0}, {2, 2, 2}, true);
  BakeRequest request;
  request.radiosity.wanted = true;
  const test::BakeResult result = test::runBake(scene, request);
  EXPECT_EQ(result.report.rays, 0u);
  for (const glm::vec3& e : *result.bake.irradiance) EXPECT_EQ(e, glm::vec3(0.0f));
}

TEST(RadiosityBake, MoreThanTheMemory_IsSaidBeforeItStarts) {
  CompiledScene scene = test::box(20, {0, 0, 0}, {2, 2, 2}, true);
  scene.lights = {pointLight({5, 3, 1}, {1, 1.7, 1})};
  BakeRequest request;
  request.radiosity.wanted = true;
  request.maxMemory = 1u << 20;
  try {
    test::runBake(scene, request);
    FAIL() << "it fitted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
    EXPECT_NE(std::string(error.what()).find("BakeRequest::maxMemory"), std::string::npos);
  }
}

TEST(RadiosityBake, SameSeed_SameBytes_OtherSeed_OtherOnes) {
  CompiledScene scene = test::box(3, {0, 0, 0}, {2, 2, 2}, true);
  scene.materials[0].albedo = glm::vec3(0.5f);
  scene.lights = {pointLight({5, 3, 1}, {1, 1.7, 1})};
  BakeRequest request;
  request.radiosity.wanted = true;
  request.effort.rays = 128;
  const Bake a = test::runBake(scene, request).bake, b = test::runBake(scene, request).bake;
  request.seed = 1;
  const Bake c = test::runBake(scene, request).bake;
  EXPECT_EQ(*a.irradiance, *b.irradiance);
  EXPECT_NE(*a.irradiance, *c.irradiance);
}

TEST(RadiosityBake, BesidesOtherTechniques_ChangesNeither) {
  CompiledScene scene = test::box(3, {0, 0, 0}, {2, 2, 2}, true);
  scene.materials[0].albedo = glm::vec3(0.5f);
  scene.lights = {pointLight({5, 3, 1}, {1, 1.7, 1})};
  BakeRequest request;
  request.effort.rays = 64;
  request.ao = true;
  const Bake ao = test::runBake(scene, request).bake;
  request.radiosity.wanted = true;
  const Bake both = test::runBake(scene, request).bake;
  request.ao = false;
  const test::BakeResult alone = test::runBake(scene, request);
  EXPECT_EQ(ao.ao, both.ao);
  EXPECT_EQ(*both.irradiance, *alone.bake.irradiance);
  EXPECT_TRUE(alone.bake.ao.empty());
  EXPECT_EQ(alone.report.receivers, 0u);
  ASSERT_TRUE(alone.report.radiosity);
  EXPECT_TRUE(alone.report.radiosity->solve.converged);
}

}  // namespace
}  // namespace prelight
