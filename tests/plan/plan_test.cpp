#include "prelight/plan.h"
#include "bake/make_plan.h"

#include <gtest/gtest.h>

#include "support/instanced_scene.h"
#include "support/scenes.h"
#include "techniques/light_map/light_map_plan.h"

namespace prelight {
namespace {

BakeRequest requestOfMany() {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 3;
  request.bounces = 1;
  return request;
}

std::string reasonOf(const Plan& plan, Pass name) {
  for (const auto& pass : plan.passes)
    if (pass.name == name.name) return pass.reason;
  return "no such pass";
}

TEST(Plan, EveryPass_HasAReason) {
  const Plan plan = makePlan(Scene(), test::ground(4, 1.0f), requestOfMany());
  ASSERT_FALSE(plan.passes.empty());
  for (const auto& pass : plan.passes) EXPECT_FALSE(pass.reason.empty()) << pass.name;
}

TEST(Plan, RequestOfManyTechniques_RunsWhatItAsksFor) {
  const Plan plan = makePlan(Scene(), test::ground(4, 1.0f), requestOfMany());
  for (const Pass pass : {Pass::Cast, Pass::AmbientOcclusion, Pass::ShTransfer, Pass::Bounces})
    EXPECT_TRUE(plan.runs(pass)) << pass.name;
  for (const Pass pass : {Pass::AlphaTest, Pass::AlbedoTextures, Pass::SpecularTransport})
    EXPECT_FALSE(plan.runs(pass)) << pass.name;
}

/// Instances of one square of `cells` cells, side by side.
CompiledScene repeatedGround(int cells, int drawings) {
  Scene scene;
  scene.meshes = {test::meshOf(test::ground(cells, 1.0f))};
  MeshNode node{0, "squares", 0, {}};
  for (int i = 0; i < drawings; ++i) {
    glm::dmat4 transform(1.0);
    transform[3].x = 2.5 * i;
    node.transforms.push_back(transform);
  }
  scene.meshNodes = {node};
  return test::compiled(scene);
}

TEST(Plan, MeshDrawnOften_IsStoredOnceAndSaysSo) {
  const CompiledScene scene = repeatedGround(100, 110);
  const Plan plan = makePlan(Scene(), scene, requestOfMany());
  EXPECT_TRUE(plan.runs(Pass::Instances));
  EXPECT_NE(reasonOf(plan, Pass::Instances).find("20000 of the scene's 2200000"), std::string::npos);
  EXPECT_NE(reasonOf(plan, Pass::Instances).find("110 drawings of 1 meshes"), std::string::npos);
  CompiledScene alone = scene;
  alone.shapes.clear();
  alone.instances.clear();
  const Plan flat = makePlan(Scene(), alone, requestOfMany());
  EXPECT_FALSE(flat.runs(Pass::Instances));
  EXPECT_LT(plan.deviceBytes + 2180000u * 100u, flat.deviceBytes + 1u);
}

TEST(Plan, FewTrianglesSaved_KeepOneTree) {
  EXPECT_FALSE(makePlan(Scene(), repeatedGround(10, 30), requestOfMany()).runs(Pass::Instances));
  EXPECT_FALSE(makePlan(Scene(), repeatedGround(1, 30), requestOfMany()).runs(Pass::Instances));
  EXPECT_FALSE(makePlan(Scene(), repeatedGround(100, 1), requestOfMany()).runs(Pass::Instances));
}

TEST(Plan, NoBounces_NeedsAnyHitsOnlyAndNoRows) {
  BakeRequest request = requestOfMany();
  request.bounces = 0;
  const Plan plan = makePlan(Scene(), test::ground(4, 1.0f), request);
  EXPECT_FALSE(plan.runs(Pass::Bounces));
  EXPECT_EQ(plan.transportBytes, 0u);
  EXPECT_NE(reasonOf(plan, Pass::Cast).find("any hit"), std::string::npos);
}

TEST(Plan, BlackScene_SkipsBouncesAndSaysWhy) {
  const Plan plan =
      makePlan(Scene(), test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 0.0f), requestOfMany());
  EXPECT_FALSE(plan.runs(Pass::Bounces));
  EXPECT_NE(reasonOf(plan, Pass::Bounces).find("albedo"), std::string::npos);
}

TEST(Plan, Radiosity_NeedsLightAndSurfacesThatReflect) {
  BakeRequest request;
  request.radiosity.wanted = true;
  CompiledScene scene = test::ground(4, 1.0f);
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::Radiosity));
  EXPECT_NE(reasonOf(makePlan(Scene(), scene, request), Pass::Radiosity).find("nothing in the scene shines"),
            std::string::npos);
  scene.lights.emplace_back();
  const Plan plan = makePlan(Scene(), scene, request);
  EXPECT_TRUE(plan.runs(Pass::Radiosity));
  EXPECT_TRUE(plan.runs(Pass::FormFactors));
  EXPECT_FALSE(plan.runs(Pass::Cast));
  scene.materials[0].albedo = glm::vec3(0.0f);
  EXPECT_TRUE(makePlan(Scene(), scene, request).runs(Pass::Radiosity));
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::FormFactors));
}

TEST(Plan, BlackSky_IsAsGoodAsNone) {
  BakeRequest request;
  request.radiosity.wanted = request.lightMap.wanted = true;
  const CompiledScene scene = test::ground(4, 1.0f);
  request.radiosity.environment = std::make_shared<Environment>(constantEnvironment(glm::vec3(0.0f)));
  const Plan dark = makePlan(Scene(), scene, request);
  for (const Pass pass : {Pass::Radiosity, Pass::SkyLightOfTheMap, Pass::IndirectLightOfTheMap})
    EXPECT_FALSE(dark.runs(pass)) << pass.name;
  EXPECT_NE(reasonOf(dark, Pass::SkyLightOfTheMap).find("black"), std::string::npos);
  request.radiosity.environment =
      std::make_shared<Environment>(constantEnvironment(glm::vec3(0.0f, 0.0f, 1e-3f)));
  const Plan lit = makePlan(Scene(), scene, request);
  for (const Pass pass : {Pass::Radiosity, Pass::SkyLightOfTheMap, Pass::IndirectLightOfTheMap})
    EXPECT_TRUE(lit.runs(pass)) << pass.name;
}

TEST(Plan, NormalMapOfAnyTriangle_AsksForDirectionsOfTheMap) {
  BakeRequest request;
  request.lightMap.wanted = true;
  Scene source;
  source.materials.resize(2);
  CompiledScene scene = test::ground(1, 1.0f);
  ASSERT_EQ(scene.triangleCount(), 2u);
  scene.materials.insert(scene.materials.begin(), scene.materials[0]);
  scene.materials[1].normalTexture.image = 0;
  for (const std::uint32_t mapped : {0u, 1u}) {
    scene.triangleMaterials = {mapped == 0 ? 1u : 0u, mapped};
    const Plan plan = makePlan(source, scene, request);
    EXPECT_TRUE(plan.runs(Pass::DirectionsOfTheMap)) << "of triangle " << mapped;
    EXPECT_NE(reasonOf(plan, Pass::DirectionsOfTheMap).find("1 material"), std::string::npos);
  }
  scene.triangleMaterials = {0, 0};
  EXPECT_FALSE(makePlan(source, scene, request).runs(Pass::DirectionsOfTheMap));
}

TEST(Plan, EmptyScene_RunsNothing) {
  const Plan plan = makePlan(Scene(), CompiledScene(), requestOfMany());
  ASSERT_FALSE(plan.passes.empty());
  for (const auto& pass : plan.passes) EXPECT_FALSE(pass.runs) << pass.name;
}

TEST(Plan, TransportRows_StayWithinTheMemoryAllowed) {
  BakeRequest request = requestOfMany();
  request.effort.rays = 1 << 18;
  const CompiledScene scene = test::ground(40, 1.0f);
  const std::size_t allowed = std::size_t{600} << 20;
  request.maxMemory = 8 * allowed;
  EXPECT_GT(makePlan(Scene(), scene, request).transportBytes, allowed);
  request.maxMemory = allowed;
  const Plan plan = makePlan(Scene(), scene, request);
  EXPECT_GT(plan.transportBytes, allowed / 4);
  EXPECT_LE(plan.hostBytes + plan.deviceBytes, allowed);
}

// The limit holds for any number of rays; only the scene's own values come on top.
TEST(Plan, NoMemoryGiven_KeepsToTheUsual) {
  BakeRequest request = requestOfMany();
  request.effort.rays = 1 << 18;
  const CompiledScene scene = test::ground(40, 1.0f);
  const Plan plan = makePlan(Scene(), scene, request);
  EXPECT_GT(plan.recordBytes + plan.transportBytes, std::uint64_t{100'000'000});
  EXPECT_LE(plan.hostBytes + plan.deviceBytes,
            300'000'000 + 400 * scene.triangleCount() + 200 * scene.vertexCount());
}

// Texels of one size over 4 m2, with 200 and with 20 000 triangles.
TEST(Plan, MemoryOfALightMap_GrowsWithTexelsValuesAndTriangles) {
  BakeRequest request;
  request.lightMap.texelSize = 0.01;
  const CompiledScene coarse = test::ground(10, 1.0f), fine = test::ground(100, 1.0f);
  const double triangles = double(fine.triangleCount()) - double(coarse.triangleCount());
  const auto bytes = [&](const CompiledScene& scene, double texel, int coefficients) {
    request.lightMap.texelSize = texel;
    return double(lightMapBytes(scene, request, coefficients));
  };
  // Each triangle needs at least two faces of three corners and a chart each.
  const double aTriangle = (bytes(fine, 0.01, 1) - bytes(coarse, 0.01, 1)) / triangles;
  EXPECT_GE(aTriangle, 2.0 * (3 * sizeof(glm::vec2) + sizeof(std::uint32_t)));
  EXPECT_LE(aTriangle, 1000.0);
  // Each coefficient needs at least three float channels for each of the 40 000 texels.
  const double values = bytes(coarse, 0.01, 5) - bytes(coarse, 0.01, 1);
  EXPECT_GE(values, 4 * 3 * sizeof(float) * 40000.0);
  EXPECT_NEAR(bytes(coarse, 0.005, 5) - bytes(coarse, 0.005, 1), 4.0 * values, 1e-3 * values);
}

TEST(Plan, ShadowSets_AreCountedWithTheirTrees) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(8, 0.2f, {0, 1, 0}));
  BakeRequest request = requestOfMany();
  const Plan whole = makePlan(Scene(), scene, request);
  EXPECT_FALSE(whole.runs(Pass::ShadowSets));
  request.shadowSets = {{{"node 0"}, {"node 0"}}};
  const Plan part = makePlan(Scene(), scene, request);
  EXPECT_TRUE(part.runs(Pass::ShadowSets));
  EXPECT_NE(reasonOf(part, Pass::ShadowSets).find("32 triangles"), std::string::npos);
  EXPECT_GT(part.deviceBytes, whole.deviceBytes);
  request.shadowSets = {{{"*"}, {"*"}}};
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::ShadowSets));
}

TEST(Plan, VectorsOfOccluders_AreThoseThatTheSceneNeeds) {
  CompiledScene scene = test::ground(4, 1.0f);
  BakeRequest request;
  request.occluders.wanted = true;
  const Plan plain = makePlan(Scene(), scene, request);
  EXPECT_TRUE(plain.runs(Pass::VectorOccluders));
  EXPECT_FALSE(plain.runs(Pass::CausticVectors));
  EXPECT_FALSE(plain.runs(Pass::SpecularVectors));
  EXPECT_EQ(plain.transportBytes, 0u);
  EXPECT_NE(reasonOf(plain, Pass::CausticVectors).find("no material lets light through"), std::string::npos);
  scene.materials[0].transmission = 0.5f;
  EXPECT_TRUE(makePlan(Scene(), scene, request).runs(Pass::CausticVectors));
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::SpecularVectors)) << "rough";
  scene.materials[0].metallic = 1.0f;
  scene.materials[0].roughness = 0.3f;
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::CausticVectors)) << "metal lets nothing through";
  EXPECT_TRUE(makePlan(Scene(), scene, request).runs(Pass::SpecularVectors));
  const auto specularReason = [&] {
    return reasonOf(makePlan(Scene(), scene, request), Pass::SpecularVectors);
  };
  EXPECT_NE(specularReason().find("from outside"), std::string::npos);
  scene.lights.emplace_back();
  scene.lights[0].position = {0.5, 0.0, 0.5};
  EXPECT_NE(specularReason().find("for 0.707 m"), std::string::npos) << specularReason();
  scene.lights[0].position.y = 3.0;
  EXPECT_NE(specularReason().find("from outside"), std::string::npos);
  request.occluders.wanted = false;
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::SpecularVectors));
}

/// A ground with a ball of glass above it.
CompiledScene glassBall() {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::sphere(4, 0.3f, {0.0f, 0.5f, 0.0f}));
  scene.materials[1].transmission = 1.0f;
  scene.materials[1].albedo = glm::vec3(0.0f);
  return scene;
}

TEST(Plan, MirrorsAndGlass_AreNamedAsOccluders) {
  const Plan plan = makePlan(Scene(), glassBall(), requestOfMany());
  EXPECT_FALSE(plan.runs(Pass::SpecularTransport));
  EXPECT_NE(reasonOf(plan, Pass::SpecularTransport).find("1 transmissive"), std::string::npos);
}

TEST(Plan, SpecularTransport_RunsWhereItIsAskedForAndNeeded) {
  BakeRequest request = requestOfMany();
  request.specular = true;
  const auto reason = [&](const CompiledScene& scene) {
    return reasonOf(makePlan(Scene(), scene, request), Pass::SpecularTransport);
  };
  const Plan plan = makePlan(Scene(), glassBall(), request);
  EXPECT_TRUE(plan.runs(Pass::SpecularTransport));
  EXPECT_NE(reasonOf(plan, Pass::ShTransfer).find("3 channels"), std::string::npos);
  EXPECT_NE(reason(test::ground(4, 1.0f)).find("no material is transmissive"), std::string::npos);
  EXPECT_EQ(reason(glassBall()).find("not carried on"), std::string::npos);
  CompiledScene lit = glassBall();
  lit.lights.emplace_back();
  lit.lights[0].position = {0.5, 0.3, 0.5};
  EXPECT_NE(reason(lit).find("the light of a light within the scene is not carried on"), std::string::npos)
      << reason(lit);
  request.limits.farthest = 1.0;
  EXPECT_NE(reason(glassBall()).find("limits of distance"), std::string::npos);
  request = BakeRequest{.ao = true, .specular = true};
  EXPECT_NE(reason(glassBall()).find("no technique that is asked for"), std::string::npos);
}

}  // namespace
}  // namespace prelight
