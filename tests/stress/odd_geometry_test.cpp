// Legal but rare triangles: which is hit, in which order, and that all results are finite.
#include <gtest/gtest.h>

#include <cmath>

#include "bvh/builder.h"
#include "gpu/tracer.h"
#include "oracle/brute_force.h"
#include "stress/closed_meshes.h"
#include "stress/hit_bounds.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

class OddGeometryTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  static Tracer tracerOf(const CompiledScene& scene) { return {scene, test::sharedDevice(), GetParam()}; }

  static bool isMiss(const Hit& hit) { return hit.triangle == PRELIGHT_NO_TRIANGLE; }

  // Expects that rays from around a scene agree with all triangles in double precision. Returns the number of
  // hits.
  static std::size_t expectAgreement(const CompiledScene& scene, const std::vector<Ray>& rays) {
    Tracer tracer = tracerOf(scene);
    const auto closest = tracer.traceClosest(rays);
    const auto any = tracer.traceAny(rays);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits += !isMiss(closest[i]);
      EXPECT_EQ(test::disagreement(scene, rays[i], closest[i], any[i]), "") << "ray " << i;
    }
    return hits;
  }
};

std::vector<Ray> raysAtTriangles(const CompiledScene& scene, std::size_t count, float distance) {
  test::Counter random(21);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t = scene.triangles[random.below(scene.triangles.size())];
    const float u = random.uniform(), v = random.uniform() * (1.0f - u);
    const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z];
    const glm::vec3 from = a + distance * random.direction();
    rays.push_back(test::makeRay(from, a + u * (b - a) + v * (c - a) - from));
  }
  return rays;
}

/// Triangles with an edge of `length` and a height of length / aspect, anywhere in the unit cube.
CompiledScene sliverSoup(std::size_t count, float length, float aspect) {
  test::Counter random(22);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 a(random.uniform(), random.uniform(), random.uniform());
    const glm::vec3 along = length * random.direction();
    positions.push_back(a);
    positions.push_back(a + along);
    positions.push_back(a + random.uniform() * along + length / aspect * random.direction());
    const auto first = static_cast<std::uint32_t>(3 * i);
    triangles.emplace_back(first, first + 1, first + 2);
  }
  return test::sceneOf(std::move(positions), std::move(triangles));
}

TEST_P(OddGeometryTest, Slivers_AgreeWithDoublePrecision) {
  for (const float aspect : {1e2f, 1e4f, 1e6f}) {
    const CompiledScene scene = sliverSoup(400, 0.5f, aspect);
    expectAgreement(scene, raysAtTriangles(scene, 4000, 0.7f));
  }
}

TEST_P(OddGeometryTest, HugeBesideTiny_AgreesWithDoublePrecision) {
  CompiledScene scene = test::sphere(8, 1e-3f, {0.1f, 2e-3f, 0.2f});
  test::append(scene, test::ground(1, 1e8f));
  test::append(scene, test::box(1, glm::vec3(-5), glm::vec3(5), true));
  test::append(scene, test::sceneOf({{1e8f, -1e8f, -3}, {-1e8f, -1e8f, -2}, {0, 1e8f, -4}}, {{0, 1, 2}}));
  EXPECT_GT(expectAgreement(scene, raysAtTriangles(scene, 4000, 0.01f)), 3000u);
  EXPECT_GT(expectAgreement(scene, raysAtTriangles(scene, 4000, 3.0f)), 3000u);
}

TEST_P(OddGeometryTest, CoincidentFaces_LowestIndexWins) {
  constexpr std::uint32_t copies = 40;
  const CompiledScene one = test::sphere(6, 1.0f, {0, 0, 0});
  const std::uint32_t count = one.triangleCount();
  CompiledScene scene = one;
  for (std::uint32_t i = 1; i < copies; ++i) test::append(scene, one);
  Tracer tracer = tracerOf(scene), alone = tracerOf(one);
  test::Counter random(23);
  std::vector<Ray> rays;
  for (int i = 0; i < 20000; ++i)
    rays.push_back(test::makeRay(0.5f * random.uniform() * random.direction(), random.direction()));
  // Aims at vertices and edges too, where triangles of one copy tie as well.
  for (const auto& t : one.triangles) {
    rays.push_back(test::makeRay({0, 0, 0}, one.positions[t.x]));
    rays.push_back(test::makeRay({0, 0, 0}, one.positions[t.x] + one.positions[t.y]));
  }
  const auto hits = tracer.traceClosest(rays), expected = alone.traceClosest(rays),
             again = tracer.traceClosest(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_LT(expected[i].triangle, count);
    EXPECT_EQ(hits[i].triangle, expected[i].triangle) << "ray " << i;
    EXPECT_EQ(hits[i].t, expected[i].t) << "ray " << i;
    EXPECT_EQ(again[i].triangle, hits[i].triangle) << "ray " << i;
  }
}

TEST_P(OddGeometryTest, HundredThousandCoincidentTriangles_AreHit) {
  const CompiledScene scene =
      test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::uvec3>(100'000, {0, 1, 2}));
  EXPECT_LE(buildBvh(scene).depth, BinaryBvh::maxDepth);
  Tracer tracer = tracerOf(scene);
  const std::vector<Ray> rays{
      test::makeRay({0.25f, 0.25f, 1}, {0, 0, -1}), test::makeRay({0.25f, 0.25f, 1}, {0, 0, -1}, 2.0f, 0),
      test::makeRay({0, 0, 1}, {0, 0, -1}), test::makeRay({0.75f, 0.75f, 1}, {0, 0, -1})};
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  const std::vector<std::uint32_t> expected{0, 1, 0, PRELIGHT_NO_TRIANGLE};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(closest[i].triangle, expected[i]) << "ray " << i;
    EXPECT_EQ(isMiss(any[i]), isMiss(closest[i])) << "ray " << i;
  }
}

// The centroids lie in a row, each at a fraction of the previous distance: no spatial split halves them.
TEST_P(OddGeometryTest, TrianglesThatShrinkTowardsAPoint_DepthStaysBounded) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < 3000; ++i) {
    const float size = std::exp2(-static_cast<float>(i % 120));
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {{size, 0, 0}, {1.5f * size, 0, 0}, {size, 0.5f * size, 0}});
    triangles.emplace_back(first, first + 1, first + 2);
  }
  const CompiledScene scene = test::sceneOf(std::move(positions), std::move(triangles));
  EXPECT_LE(buildBvh(scene).depth, BinaryBvh::maxDepth);
  expectAgreement(scene, raysAtTriangles(scene, 500, 0.5f));
}

TEST_P(OddGeometryTest, TrianglesOfNoArea_AreNeverHit) {
  const float third = 1.0f / 3.0f;
  std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {third, third, third}, {0.1f, 0.7f, 0.3f}};
  const CompiledScene scene =
      test::sceneOf(positions, {{0, 0, 0}, {1, 1, 1}, {0, 0, 1}, {2, 3, 3}, {3, 2, 3}, {2, 2, 3}, {2, 2, 2}});
  Tracer tracer = tracerOf(scene);
  const auto rays = raysAtTriangles(scene, 20000, 0.5f);
  for (const auto& hits : {tracer.traceClosest(rays), tracer.traceAny(rays)})
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_TRUE(isMiss(hits[i])) << "ray " << i;
}

TEST(OddGeometry, TrianglesOfNoArea_AreDroppedWhenCompiled) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].primitives.resize(1);
  auto& primitive = scene.meshes[0].primitives[0];
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}};
  primitive.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {0, 4, 5}, {1, 1, 1}};
  scene.meshNodes = {{0, "node", 0, {glm::dmat4(1.0)}}};
  Warnings warnings;
  const CompiledScene compiled = compileScene(scene, warnings);
  EXPECT_EQ(compiled.triangleCount(), 1u);
  EXPECT_EQ(compiled.droppedTriangles, 4u);
  EXPECT_EQ(warnings.size(), 1u);
}

// Extents near the ends of float's range lose triangles to underflow and overflow, but cause no other error.
TEST_P(OddGeometryTest, ExtentsAtTheEndsOfFloat_StayFinite) {
  for (const float scale :
       {1e-44f, 1e-38f, 1e-30f, 1e-20f, 1e-10f, 1e10f, 1e15f, 1e20f, 1e30f, 1.5e38f, 3e38f}) {
    const CompiledScene scene = test::moved(test::sphere(8, 1.0f, {0, 0, 0}), glm::vec3(scale), glm::vec3(0));
    Tracer tracer = tracerOf(scene);
    test::Counter random(24);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
      const glm::vec3 from = (random.below(2) == 0 ? 0.5f * scale : 1.0f) * random.direction();
      rays.push_back(test::makeRay(from, (random.below(2) == 0 ? scale : 1.0f) * random.direction()));
    }
    for (const auto& hits : {tracer.traceClosest(rays), tracer.traceAny(rays)}) {
      std::size_t met = 0;
      for (const Hit& hit : hits) {
        EXPECT_TRUE(std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v)) << scale;
        met += !isMiss(hit);
      }
      // Half of the rays start inside the sphere; between these scales products of three coordinates are
      // floats.
      if (scale > 1e-11f && scale < 1e11f) {
        EXPECT_GE(met, rays.size() / 3) << scale;
      }
    }
  }
}

// With a spread of 3e38 on both sides of 0, sums and differences of coordinates overflow.
TEST_P(OddGeometryTest, CoordinatesWhoseSumsOverflow_BuildAndStayFinite) {
  test::Counter random(25);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 place =
        3.3e38f * glm::vec3(static_cast<float>(random.below(3)) - 1.0f, random.between(-1, 1), 0.5f);
    for (int k = 0; k < 3; ++k) positions.push_back(place * random.between(0.99f, 1.0f));
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  CompiledScene scene = test::sceneOf(std::move(positions), std::move(triangles));
  test::append(scene, test::ground(2, 1.0f));
  Tracer tracer = tracerOf(scene);
  std::vector<Ray> rays{test::makeRay({0.3f, 1, 0.2f}, {0, -1, 0})};
  for (int i = 0; i < 1000; ++i) rays.push_back(test::makeRay({0.1f, 1, 0.2f}, random.direction()));
  const auto hits = tracer.traceClosest(rays);
  EXPECT_EQ(hits[0].t, 1.0f);
  for (const Hit& hit : hits)
    EXPECT_TRUE(std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v));
}

TEST_P(OddGeometryTest, SingleTriangle_AgreesWithDoublePrecision) {
  const CompiledScene scene =
      test::sceneOf({{0.1f, 0.2f, 0.3f}, {1.1f, 0.3f, 0}, {0.4f, 1.2f, 0.7f}}, {{0, 1, 2}});
  EXPECT_GT(expectAgreement(scene, raysAtTriangles(scene, 10000, 1.0f)), 9000u);
}

TEST_P(OddGeometryTest, MillionTriangles_AgreeWithDoublePrecision) {
  const CompiledScene scene = test::randomSoup(1'000'000, 0.02f, 26);
  Tracer tracer = tracerOf(scene);
  test::Counter random(27);
  std::vector<Ray> rays;
  for (int i = 0; i < 200'000; ++i)
    rays.push_back(test::makeRay({random.uniform(), random.uniform(), random.uniform()}, random.direction()));
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& h = closest[i];
    ASSERT_TRUE(std::isfinite(h.t) && std::isfinite(h.u) && std::isfinite(h.v)) << "ray " << i;
    ASSERT_EQ(isMiss(h), isMiss(any[i])) << "ray " << i;
  }
  constexpr std::size_t compared = 40;
  std::size_t same = 0;
  for (std::size_t i = 0; i < compared; ++i) {
    EXPECT_EQ(test::disagreement(scene, rays[i], closest[i], any[i]), "") << "ray " << i;
    const glm::dvec3 o(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]),
        d(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    const auto exact = reference::closestHit(scene, o, d, rays[i].tMax, PRELIGHT_NO_TRIANGLE);
    same += exact ? exact->triangle == closest[i].triangle : isMiss(closest[i]);
  }
  EXPECT_GE(same, compared - 1) << "more than rounding at edges explains";
}

INSTANTIATE_TEST_SUITE_P(Layouts, OddGeometryTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

}  // namespace
}  // namespace prelight
