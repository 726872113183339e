#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/resumed.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

Bake bake(const CompiledScene& scene, const BakeRequest& request, Progress& progress) {
  BakeReport report;
  return bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report);
}

Bake bake(const CompiledScene& scene, const BakeRequest& request) {
  Progress progress;
  return bake(scene, request, progress);
}

/// AO and SH of order 3 with bounces, and what receivers see.
BakeRequest requestOf(std::vector<ShadowSetRequest> sets, int bounces = 0, std::uint64_t rays = 256) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 3;
  request.bounces = bounces;
  request.effort.rays = rays;
  request.shadowSets = std::move(sets);
  return request;
}

/// Node 0 is a ground, node 1 a red sphere above it, node 2 a box beside the sphere.
CompiledScene groundSphereBox() {
  CompiledScene scene = test::ground(8, 2.0f);
  test::append(scene, test::sphere(8, 0.5f, {0.0f, 0.8f, 0.0f}));
  test::append(scene, test::box(3, {0.8f, 0.2f, -0.4f}, {1.4f, 0.9f, 0.4f}, false));
  for (auto& material : scene.materials) material.albedo = glm::vec3(0.7f);
  scene.materials[1].albedo = {0.9f, 0.1f, 0.1f};
  return scene;
}

std::span<const float> partOf(const std::vector<float>& values, const CompiledScene& scene,
                              std::size_t primitive) {
  const std::size_t width = values.size() / scene.vertexCount();
  const PrimitiveRange& range = scene.primitives[primitive];
  return std::span(values).subspan(range.firstVertex * width, range.vertexCount * width);
}

double largestDifference(std::span<const float> a, std::span<const float> b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most;
}

/// Clamped cosine along +Y over pi, order 3.
constexpr std::array<double, 9> openGround = {
    0.28209479177387814,        2.0 / 3.0 * 0.48860251190291992, 0, 0, 0, 0, 0.25 * -0.31539156525252005, 0,
    0.25 * -0.54627421529603959};

TEST(ShadowSets, WithoutOccluders_EveryReceiverIsOpen) {
  const CompiledScene scene = groundSphereBox();
  const Bake result = bake(scene, requestOf({{{"*"}, {}}}));
  for (const float ao : result.ao) EXPECT_EQ(ao, 1.0f);
  const auto ground = partOf(result.sh->coefficients, scene, 0);
  for (std::size_t i = 0; i < ground.size(); ++i) EXPECT_NEAR(ground[i], openGround[i % 9], 1e-6);
}

// A change on one node moves the samples of the others, which therefore differ by the noise of 4096 rays.
TEST(ShadowSets, OnlyReceiversThatAreNamed_AreChanged) {
  const CompiledScene scene = groundSphereBox();
  const Bake all = bake(scene, requestOf({}, 0, 4096));
  const Bake part = bake(scene, requestOf({{{"node 0"}, {"node 0"}}}, 0, 4096));
  for (const float ao : partOf(part.ao, scene, 0)) EXPECT_EQ(ao, 1.0f);
  EXPECT_LT(*std::min_element(all.ao.begin(), all.ao.begin() + 81), 0.7f);
  for (const std::size_t node : {1u, 2u}) {
    EXPECT_LT(largestDifference(partOf(part.ao, scene, node), partOf(all.ao, scene, node)), 0.02);
    EXPECT_LT(largestDifference(partOf(part.sh->coefficients, scene, node),
                                partOf(all.sh->coefficients, scene, node)),
              0.02);
  }
}

// A node that a receiver does not see might as well not be there.
TEST(ShadowSets, LeftOutNode_IsAsIfItWereNotThere) {
  const CompiledScene scene = groundSphereBox();
  CompiledScene without = test::ground(8, 2.0f);
  test::append(without, test::sphere(8, 0.5f, {0.0f, 0.8f, 0.0f}));
  without.materials[0].albedo = glm::vec3(0.7f);
  without.materials[1].albedo = {0.9f, 0.1f, 0.1f};
  const Bake set = bake(scene, requestOf({{{"node 0", "node 1"}, {"node 0", "node 1"}}}, 2, 4096));
  const Bake truth = bake(without, requestOf({}, 2, 4096));
  for (const std::size_t node : {0u, 1u}) {
    EXPECT_LT(largestDifference(partOf(set.ao, scene, node), partOf(truth.ao, without, node)), 0.02);
    EXPECT_LT(largestDifference(partOf(set.sh->coefficients, scene, node),
                                partOf(truth.sh->coefficients, without, node)),
              0.02);
  }
}

TEST(ShadowSets, ReceiverInSeveral_SeesTheUnion) {
  const CompiledScene scene = groundSphereBox();
  const Bake two = bake(scene, requestOf({{{"node 0"}, {"node 1"}}, {{"node ?"}, {"node 2"}}}));
  const Bake one =
      bake(scene, requestOf({{{"node 0"}, {"node 2", "node 1"}}, {{"node 1", "node 2"}, {"node 2"}}}));
  EXPECT_EQ(two.ao, one.ao);
  EXPECT_EQ(two.sh->coefficients, one.sh->coefficients);
}

TEST(ShadowSets, SenderOutsideTheSet_ReflectsNothing) {
  const CompiledScene scene = groundSphereBox();
  const Bake blind = bake(scene, requestOf({{{"node 0"}, {"node 2"}}}, 1));
  const Bake seeing = bake(scene, requestOf({{{"node 0"}, {"node 1"}}}, 1));
  double redBlind = 0.0, redSeeing = 0.0;  // Red minus green under a white sky.
  for (std::size_t v = 0; v < 81; ++v) {
    const auto excess = [&](const Bake& b) {
      return double(b.sh->coefficients[v * 27] - b.sh->coefficients[v * 27 + 9]);
    };
    redBlind = std::max(redBlind, std::abs(excess(blind)));
    redSeeing = std::max(redSeeing, excess(seeing));
  }
  // The box has seen the red sphere, so that a trace of red arrives by way of the box.
  EXPECT_LT(redBlind, 1e-6);
  EXPECT_GT(redSeeing, 0.01);
}

TEST(ShadowSets, EmitterOutsideTheSet_DoesNotShine) {
  CompiledScene scene = groundSphereBox();
  scene.materials[1].emission = glm::vec3(1.0f);
  BakeRequest request = requestOf({{{"node 0"}, {"node 2"}}});
  request.lightGroups.wanted = true;
  const Bake blind = bake(scene, request);
  for (const float value : partOf(blind.lightGroups->coefficients, scene, 0)) EXPECT_EQ(value, 0.0f);
  request.shadowSets = {{{"node 0"}, {"node 1"}}};
  const auto lit = bake(scene, request).lightGroups->coefficients;
  EXPECT_GT(*std::max_element(lit.begin(), lit.begin() + 81), 0.05f);
}

// Two squares meet along x = 0 with the same positions and normals there; one sees the wall above the seam.
TEST(ShadowSets, NodesOfDifferentSets_DoNotShareVertices) {
  const std::vector<glm::uvec3> quad = {{0, 1, 2}, {0, 2, 3}};
  CompiledScene scene = test::sceneOf({{-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0, -1}}, quad);
  test::append(scene, test::sceneOf({{0, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0, 0, -1}}, quad));
  test::append(scene, test::sceneOf({{-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.5f, 1}, {-1, 0.5f, 1}}, quad));
  const Bake result = bake(scene, requestOf({{{"node 0"}, {}}}));
  for (const float ao : partOf(result.ao, scene, 0)) EXPECT_EQ(ao, 1.0f);
  for (const float ao : partOf(result.ao, scene, 1)) EXPECT_LT(ao, 0.8f);
}

TEST(ShadowSets, PatternThatNothingMatches_NamesTheNodes) {
  CompiledScene scene = groundSphereBox();
  scene.primitives[1].name = "Ball";
  for (const ShadowSetRequest& bad : {ShadowSetRequest{{"Floor*"}, {}}, ShadowSetRequest{{"*"}, {"Floor*"}}})
    try {
      makeShadowSets(scene, {bad});
      FAIL() << "no error";
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("Floor*"));
      EXPECT_THAT(error.what(), HasSubstr("Ball"));
      EXPECT_THAT(error.what(), HasSubstr("node 2"));
    }
}

TEST(ShadowSets, InterruptedAndContinued_EndsAsIfNeverInterrupted) {
  const CompiledScene scene = groundSphereBox();
  const BakeRequest request = requestOf({{{"node 0"}, {"node 1"}}, {{"node 2"}, {}}}, 1, 4096);
  const Bake whole = bake(scene, request);
  const Bake parts = test::inManyRuns([&](Progress& progress) { return bake(scene, request, progress); }, 4);
  EXPECT_EQ(parts.ao, whole.ao);
  EXPECT_EQ(parts.sh->coefficients, whole.sh->coefficients);
}

class PartialTracer : public ::testing::TestWithParam<BvhLayout> {};

TEST_P(PartialTracer, Hits_AreThoseOfASceneOfThePartWithTheWholesIndices) {
  const CompiledScene whole = test::randomSoup(3000, 0.2f, 5);
  std::vector<std::uint32_t> part;
  for (std::uint32_t t = 1; t < whole.triangleCount(); t += 3) part.push_back(t);
  CompiledScene alone = whole;
  alone.triangles.clear();
  for (const std::uint32_t t : part) alone.triangles.push_back(whole.triangles[t]);
  alone.triangleMaterials.resize(part.size());
  alone.triangleFlat.resize(part.size());

  Tracer all(whole, test::sharedDevice(), GetParam()), some(all, whole, part), none(all, whole, {});
  Tracer truth(alone, test::sharedDevice(), GetParam());
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-0.5f, 1.5f);
  std::vector<device::Ray> rays;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 d = test::randomDirection(random);
    rays.push_back(
        {{unit(random), unit(random), unit(random)}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, 1e30f});
  }
  const auto hits = some.traceClosest(rays), expected = truth.traceClosest(rays), empty = none.traceAny(rays);
  std::size_t hit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(empty[i].triangle, PRELIGHT_NO_TRIANGLE);
    if (expected[i].triangle == PRELIGHT_NO_TRIANGLE) {
      EXPECT_EQ(hits[i].triangle, PRELIGHT_NO_TRIANGLE);
      continue;
    }
    ++hit;
    EXPECT_EQ(hits[i].triangle, part[expected[i].triangle]);
    EXPECT_NEAR(hits[i].t, expected[i].t, 1e-5f);
  }
  EXPECT_GT(hit, 500u);
}

INSTANTIATE_TEST_SUITE_P(Layouts, PartialTracer, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow));

}  // namespace
}  // namespace prelight
