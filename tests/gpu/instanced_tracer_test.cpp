#include "gpu/instanced_tracer.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "gpu/tracer.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

constexpr float infinity = std::numeric_limits<float>::infinity();

Ray rayOf(const glm::vec3& o, const glm::vec3& d, std::uint32_t source = PRELIGHT_NO_TRIANGLE) {
  return {{o.x, o.y, o.z}, source, {d.x, d.y, d.z}, infinity};
}

std::vector<Ray> raysIn(float half, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-half, half);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i)
    rays.push_back(rayOf({unit(random), unit(random), unit(random)}, test::randomDirection(random)));
  return rays;
}

glm::mat4 rigid(std::mt19937& random, float half) {
  std::uniform_real_distribution<float> unit(-half, half);
  const glm::mat4 moved = glm::translate(glm::mat4(1.0f), {unit(random), unit(random), unit(random)});
  return glm::rotate(moved, 3.0f * unit(random) / half, test::randomDirection(random));
}

/// What the instances are when each has triangles of its own in the world.
CompiledScene flattened(std::span<const CompiledScene> shapes, std::span<const Instance> instances) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (const Instance& instance : instances) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    EXPECT_EQ(instance.firstTriangle, triangles.size());
    for (const glm::vec3& p : shapes[instance.shape].positions)
      positions.push_back(glm::vec3(glm::dmat4(instance.toWorld) * glm::dvec4(p, 1.0)));
    for (const glm::uvec3& t : shapes[instance.shape].triangles) triangles.push_back(t + first);
  }
  return test::sceneOf(std::move(positions), std::move(triangles));
}

class InstancedTracerTest : public ::testing::Test {
 protected:
  /// Spheres and boxes strewn about, a few of them scaled.
  std::vector<Instance> strew(std::size_t count, float half, std::uint32_t seed) const {
    std::mt19937 random(seed);
    std::vector<Instance> instances;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto shape = static_cast<std::uint32_t>(i % shapes_.size());
      const float size = i % 5 == 0 ? 0.4f : 1.0f;
      instances.push_back({shape, first, glm::scale(rigid(random, half), glm::vec3(size))});
      first += shapes_[shape].triangleCount();
    }
    return instances;
  }

  /// Where neither hit is within rounding of an edge, both are the same triangle; distances agree always.
  void expectSame(const std::vector<Hit>& hits, const std::vector<Hit>& flat, float half) const {
    std::size_t found = 0, otherwise = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const bool hit = hits[i].triangle != PRELIGHT_NO_TRIANGLE;
      found += hit;
      if (hits[i].triangle != flat[i].triangle) {
        const auto nearEdge = [](const Hit& h) { return std::min({h.u, h.v, 1.0f - h.u - h.v}) < 1e-3f; };
        EXPECT_TRUE(nearEdge(hits[i]) || nearEdge(flat[i])) << "ray " << i;
        ++otherwise;
        continue;
      }
      if (!hit) continue;
      EXPECT_NEAR(hits[i].t, flat[i].t, 1e-5f * half) << "ray " << i;
      EXPECT_NEAR(hits[i].u, flat[i].u, 1e-3f) << "ray " << i;
      EXPECT_NEAR(hits[i].v, flat[i].v, 1e-3f) << "ray " << i;
    }
    EXPECT_GT(found, hits.size() / 50);
    EXPECT_LT(otherwise, hits.size() / 200);
  }

  std::vector<CompiledScene> shapes_{test::sphere(12, 1.0f, {0.5f, 0, 0}),
                                     test::box(4, {-1, -0.5f, -1}, {1, 0.5f, 1}, false)};
};

TEST_F(InstancedTracerTest, ManyInstances_HitsAreThoseOfTheFlattenedScene) {
  for (const std::size_t count : {1u, 2u, 60u}) {
    const auto instances = strew(count, count == 1 ? 0.5f : 4.0f, 3);
    InstancedTracer tracer(shapes_, instances, test::sharedDevice());
    Tracer flat(flattened(shapes_, instances), test::sharedDevice(), BvhLayout::Narrow);
    const auto rays = raysIn(count == 1 ? 1.0f : 5.0f, 20000, 4);
    expectSame(tracer.traceClosest(rays), flat.traceClosest(rays), 5.0f);
  }
}

TEST_F(InstancedTracerTest, AnyHit_IsThereWhenClosestIs) {
  InstancedTracer tracer(shapes_, strew(40, 4.0f, 6), test::sharedDevice());
  const auto rays = raysIn(5.0f, 20000, 7);
  const auto closest = tracer.traceClosest(rays), any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    ASSERT_EQ(any[i].triangle, closest[i].triangle == PRELIGHT_NO_TRIANGLE ? PRELIGHT_NO_TRIANGLE : 0u) << i;
}

TEST_F(InstancedTracerTest, MovedInstances_HitsAreThoseOfANewTracer) {
  InstancedTracer moved(shapes_, strew(30, 4.0f, 8), test::sharedDevice());
  const auto target = strew(30, 4.0f, 9);
  std::vector<glm::mat4> toWorld;
  for (const Instance& instance : target) toWorld.push_back(instance.toWorld);
  const auto rays = raysIn(5.0f, 10000, 10);
  const auto before = moved.traceClosest(rays);
  moved.update(toWorld);
  const auto after = moved.traceClosest(rays);
  InstancedTracer anew(shapes_, target, test::sharedDevice());
  const auto expected = anew.traceClosest(rays);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(after[i].triangle, expected[i].triangle);
    ASSERT_EQ(after[i].t, expected[i].t);
    changed += before[i].triangle != after[i].triangle;
  }
  EXPECT_GT(changed, rays.size() / 10);
}

TEST_F(InstancedTracerTest, OneMovedInstance_IsHitWhereItIs) {
  InstancedTracer tracer(shapes_,
                         {{0, 0, glm::mat4(1.0f)}, {0, 528, glm::translate(glm::mat4(1.0f), {10, 0, 0})}},
                         test::sharedDevice());
  ASSERT_EQ(shapes_[0].triangleCount(), 528u);
  const std::vector<Ray> rays{rayOf({0.5f, 0.1f, 9}, {0.01f, 0, -1}),
                              rayOf({20.5f, 0.1f, 9}, {0.01f, 0, -1})};
  EXPECT_LT(tracer.traceClosest(rays)[0].triangle, 528u);
  EXPECT_EQ(tracer.traceClosest(rays)[1].triangle, PRELIGHT_NO_TRIANGLE);
  tracer.update(1, glm::translate(glm::mat4(1.0f), {20, 0, 0}));
  const Hit hit = tracer.traceClosest(rays)[1];
  EXPECT_GE(hit.triangle, 528u);
  EXPECT_NEAR(hit.t, 8.0f, 0.05f);
}

TEST_F(InstancedTracerTest, SourceTriangle_IsSkippedInItsInstanceAlone) {
  const CompiledScene quad = test::ground(1, 1.0f);
  const std::vector<CompiledScene> shapes{quad};
  InstancedTracer tracer(shapes,
                         {{0, 0, glm::mat4(1.0f)}, {0, 2, glm::translate(glm::mat4(1.0f), {0, -1, 0})}},
                         test::sharedDevice());
  const Hit first = tracer.traceClosest(std::vector<Ray>{rayOf({0.3f, 1, 0.1f}, {0, -1, 0})})[0];
  ASSERT_LT(first.triangle, 2u);
  const Hit second =
      tracer.traceClosest(std::vector<Ray>{rayOf({0.3f, 1, 0.1f}, {0, -1, 0}, first.triangle)})[0];
  EXPECT_EQ(second.triangle, first.triangle + 2);
  EXPECT_FLOAT_EQ(second.t, 2.0f);
}

// From inside a closed shape every ray must hit it, wherever it was moved to.
TEST_F(InstancedTracerTest, ClosedShape_RaysAtVerticesAndEdges_NeverLeak) {
  const std::vector<CompiledScene> shapes{test::sphere(16, 1.0f, {})};
  std::mt19937 random(11);
  for (const float distance : {0.0f, 3.0f, 300.0f}) {
    const glm::mat4 toWorld = rigid(random, distance + 0.01f);
    InstancedTracer tracer(shapes, {{0, 0, toWorld}}, test::sharedDevice());
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Ray> rays;
    for (const auto& t : shapes[0].triangles)
      for (int repeat = 0; repeat < 20; ++repeat) {
        const auto world = [&](const glm::vec3& p) { return glm::vec3(toWorld * glm::vec4(p, 1.0f)); };
        const glm::vec3 from = world(0.5f * unit(random) * test::randomDirection(random));
        const glm::vec3 a = shapes[0].positions[t.x], b = shapes[0].positions[t.y];
        rays.push_back(rayOf(from, world(a) - from));
        rays.push_back(rayOf(from, world(a + unit(random) * (b - a)) - from));
      }
    std::size_t leaks = 0;
    for (const Hit& hit : tracer.traceClosest(rays)) leaks += hit.triangle == PRELIGHT_NO_TRIANGLE;
    EXPECT_EQ(leaks, 0u) << "of " << rays.size() << " at " << distance;
  }
}

TEST_F(InstancedTracerTest, SharedShapes_TakeTheirMemoryOnce) {
  const InstancedTracer few(shapes_, strew(2, 4.0f, 1), test::sharedDevice());
  const InstancedTracer many(shapes_, strew(200, 4.0f, 1), test::sharedDevice());
  EXPECT_EQ(many.shapeBytes(), few.shapeBytes());
  EXPECT_LE(many.topBytes(), 200u * 128u);
  Tracer flat(flattened(shapes_, many.instances()), test::sharedDevice(), BvhLayout::Narrow);
  EXPECT_LT(10 * (many.shapeBytes() + many.topBytes()), flat.bvhBytes());
}

TEST_F(InstancedTracerTest, UnusableInstances_AreRefused) {
  EXPECT_THROW(InstancedTracer(shapes_, {{2, 0, glm::mat4(1.0f)}}, test::sharedDevice()), Error);
  EXPECT_THROW(
      InstancedTracer(shapes_, {{0, 0, glm::scale(glm::mat4(1.0f), {1, 0, 1})}}, test::sharedDevice()),
      Error);
}

}  // namespace
}  // namespace prelight
