#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "charts/make_light_map_layout.h"
#include "denoise/fake_library.h"
#include "prelight/bake.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/made_scenes.h"
#include "techniques/light_map/light_map_plan.h"
#include "techniques/light_map/light_map_sources.h"

// Light maps with all light are compared with radiosity, which uses no photons.
namespace prelight::test {
namespace {

struct Baked {
  Scene source;
  CompiledScene scene;
  Plan plan;
  Bake bake;
};

BakeRequest lightMapOf(double texel) {
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = texel;
  request.effort.rays = 256;
  return request;
}

Baked bakeBuiltin(const std::string& name, const BakeRequest& request) {
  Baked baked;
  Warnings warnings;
  baked.source = loadScene(makeBuiltinScene(name), warnings);
  baked.scene = compileScene(baked.source, warnings);
  baked.plan = makePlan(baked.source, baked.scene, request);
  Progress progress;
  BakeReport report;
  baked.bake =
      bakeScene(baked.scene, request, baked.plan, sharedDevice(), progress, report, nullptr, &baked.source);
  return baked;
}

/// Surface mean of irradiance that is interpolated between vertices.
double meanIrradiance(const CompiledScene& scene, const std::vector<glm::vec3>& irradiance) {
  double sum = 0.0, area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double a = glm::length(geometricNormal(scene, t));
    const glm::uvec3& v = scene.triangles[t];
    sum += a * double(irradiance[v.x].y + irradiance[v.y].y + irradiance[v.z].y) / 3.0;
    area += a;
  }
  return sum / area;
}

TEST(LightMapLight, VertexIrradiance_AgreesWithRadiosity) {
  for (const std::string name : {"rooms", "cornell"}) {
    const Baked map = bakeBuiltin(name, lightMapOf(0.1));
    BakeRequest request;
    request.radiosity.wanted = true;
    const Baked radiosity = bakeBuiltin(name, request);
    const double expected = meanIrradiance(radiosity.scene, *radiosity.bake.irradiance);
    EXPECT_NEAR(meanIrradiance(map.scene, *map.bake.irradiance), expected, 0.03 * expected) << name;
  }
}

/// The brightest texels in front of and behind the wall of rooms-sealed.
std::pair<double, double> brightestOfSealedRooms(const BakeRequest& request) {
  const Baked map = bakeBuiltin("rooms-sealed", request);
  double lit = 0.0, dark = 0.0;
  for (const LightMapTexel& texel : map.bake.lightMap->layout.texels) {
    const std::uint32_t t = texel.face % map.scene.triangleCount();
    const double x = double(map.scene.positions[map.scene.triangles[t].x].x) + map.scene.origin.x;
    const double e = double(map.bake.lightMap->values[3 * texel.texel]);
    (x < 0.0 ? lit : dark) = std::max(x < 0.0 ? lit : dark, e);
  }
  return {lit, dark};
}

/// A lamp is behind a one-sided wall, whose back reflects light as well.
TEST(LightMapLight, BackOfAOneSidedWall_ReflectsAsRadiosityHasIt) {
  CompiledScene wall = ground(4, 1.0f);  // Stands upright below, with its back to +z.
  for (glm::vec3& p : wall.positions) p = {p.x, p.z + 1.01f, 0.0f};
  for (glm::vec3& n : wall.normals) n = {0.0f, 0.0f, -1.0f};
  const LoadedScene loaded =
      SceneMaker().add("floor", ground(8, 2.0f)).add("wall", wall).addLamp({0.0, 1.0, 0.4}).make();
  ASSERT_TRUE(loaded.compiled.triangleTurns.empty());
  ASSERT_LT(geometricNormal(loaded.compiled, loaded.compiled.primitives[1].firstTriangle).z, 0.0);
  BakeRequest request = lightMapOf(0.1);
  BakeRequest solved;
  solved.radiosity.wanted = true;
  solved.effort.rays = 2048;
  const Bake mapped = bake(loaded, request).bake, exact = bake(loaded, solved).bake;
  const auto onFloor = [&](const Bake& made) {
    double sum = 0.0;
    for (std::uint32_t v = 0; v < loaded.compiled.primitives[0].vertexCount; ++v)
      if (loaded.compiled.positions[v].z + loaded.compiled.origin.z > 0.1)
        sum += double((*made.irradiance)[v].y);
    return sum;
  };
  EXPECT_NEAR(onFloor(mapped), onFloor(exact), 0.03 * onFloor(exact));
}

TEST(LightMapLight, SealedRooms_StayDarkBehindTheWall) {
  const auto [lit, dark] = brightestOfSealedRooms(lightMapOf(0.1));
  EXPECT_GT(lit, 0.0);
  EXPECT_LE(dark, 1e-4 * lit);
}

TEST(LightMapLight, SealedRoomsDenoised_StayDarkBehindTheWall) {
  const UsedLibrary library(FAKE_OIDN);
  BakeRequest request = lightMapOf(0.1);
  request.effort.rays = 64;
  request.lightMap.denoise = true;
  const auto [lit, dark] = brightestOfSealedRooms(request);
  EXPECT_GT(lit, 0.0);
  EXPECT_LE(dark, 1e-4 * lit);
}

/// All gathering rays share the errors of the photons, so that a denoiser does not remove them.
TEST(LightMapLight, Denoised_IsGatheredFromMorePhotonsUnlessSomeAreAskedFor) {
  const Baked map = bakeBuiltin("rooms", lightMapOf(0.1));
  const auto raysOfPhotons = [&](bool denoise, std::uint64_t photons) {
    BakeRequest request = lightMapOf(0.1);
    request.lightMap.denoise = denoise;
    request.lightMap.photons = photons;
    Tracer tracer(map.scene, sharedDevice());
    Progress progress;
    return double(LightMapSources(map.source, map.scene, map.bake.lightMap->layout, request, map.plan, 1,
                                  sharedDevice(), tracer, progress)
                      .rays());
  };
  const double usual = raysOfPhotons(false, 0), more = raysOfPhotons(true, 0);
  EXPECT_GT(more, 3.0 * usual);
  EXPECT_EQ(raysOfPhotons(true, 20'000), raysOfPhotons(false, 20'000));
}

TEST(LightMapLight, Caustics_AreThereWhereTheyAreAskedForAndMade) {
  BakeRequest request = lightMapOf(0.05);
  const Baked without = bakeBuiltin("caustics", request);
  EXPECT_FALSE(without.plan.runs(Pass::CausticsOfTheMap));
  request.lightMap.caustics = true;
  const Baked with = bakeBuiltin("caustics", request);
  EXPECT_TRUE(with.plan.runs(Pass::CausticsOfTheMap));
  EXPECT_FALSE(bakeBuiltin("cornell", request).plan.runs(Pass::CausticsOfTheMap));
  double more = 0.0;
  for (std::size_t i = 0; i < with.bake.lightMap->values.size(); ++i)
    more = std::max(more, double(with.bake.lightMap->values[i] - without.bake.lightMap->values[i]));
  EXPECT_GT(more, 1.0);
}

TEST(LightMapLight, Directions_AreKeptWhereThereAreNormalMaps) {
  const Baked bumps = bakeBuiltin("bumps", lightMapOf(0.2)),
              cornell = bakeBuiltin("cornell", lightMapOf(0.2));
  EXPECT_TRUE(bumps.plan.runs(Pass::DirectionsOfTheMap));
  EXPECT_EQ(bumps.bake.lightMap->coefficients, 5);
  EXPECT_EQ(bumps.bake.lightMap->values.size(), 15 * bumps.bake.lightMap->layout.texelCount());
  EXPECT_FALSE(cornell.plan.runs(Pass::DirectionsOfTheMap));
  EXPECT_EQ(cornell.bake.lightMap->coefficients, 1);
}

}  // namespace
}  // namespace prelight::test
