#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "gpu/tracer.h"
#include "oracle/brute_force.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

constexpr float unlimited = std::numeric_limits<float>::infinity();

Ray limitedRay(const glm::vec3& o, const glm::vec3& d, float tMax = unlimited,
               std::uint32_t source = PRELIGHT_NO_TRIANGLE) {
  return {{o.x, o.y, o.z}, source, {d.x, d.y, d.z}, tMax};
}

std::vector<Ray> randomRays(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-0.5f, 1.5f);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i)
    rays.push_back(limitedRay({unit(random), unit(random), unit(random)}, test::randomDirection(random)));
  return rays;
}

class TracerTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  Tracer tracerOf(const CompiledScene& scene) { return Tracer(scene, test::sharedDevice(), GetParam()); }
};

// Hits near an edge may be decided either way by rounding; everything else must be the same triangle.
void expectSameHit(const CompiledScene& scene, const Ray& ray, const Hit& hit) {
  const glm::dvec3 o(ray.origin[0], ray.origin[1], ray.origin[2]),
      d(ray.direction[0], ray.direction[1], ray.direction[2]);
  const auto exact = reference::closestHit(scene, o, d, ray.tMax, ray.sourceTriangle);
  SCOPED_TRACE(::testing::Message() << "origin " << o.x << ' ' << o.y << ' ' << o.z << " direction " << d.x
                                    << ' ' << d.y << ' ' << d.z);
  const auto nearEdge = [](double u, double v) { return std::min({u, v, 1.0 - u - v}) < 1e-4; };
  if (exact && !nearEdge(exact->u, exact->v)) {
    ASSERT_NE(hit.triangle, PRELIGHT_NO_TRIANGLE);
    if (hit.triangle == exact->triangle) {
      EXPECT_NEAR(hit.t, exact->t, 2e-5 * (1.0 + exact->t));
      EXPECT_NEAR(hit.u, exact->u, 2e-3);
      EXPECT_NEAR(hit.v, exact->v, 2e-3);
    } else {
      EXPECT_TRUE(nearEdge(hit.u, hit.v) || std::abs(hit.t - exact->t) < 1e-4)
          << hit.triangle << " for " << exact->triangle;
    }
  } else if (!exact && hit.triangle != PRELIGHT_NO_TRIANGLE) {
    EXPECT_TRUE(nearEdge(hit.u, hit.v)) << "hits what is not there";
  }
}

TEST_P(TracerTest, ClosestHit_RandomSoup_AgreesWithDoubleBruteForce) {
  for (const float size : {0.02f, 0.3f}) {
    const CompiledScene scene = test::randomSoup(700, size, 3);
    Tracer tracer = tracerOf(scene);
    const auto rays = randomRays(3000, 5);
    const auto hits = tracer.traceClosest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) expectSameHit(scene, rays[i], hits[i]);
  }
}

TEST_P(TracerTest, AnyHit_RandomSoup_IsThereWhenClosestIs) {
  const CompiledScene scene = test::randomSoup(2000, 0.15f, 9);
  Tracer tracer = tracerOf(scene);
  const auto rays = randomRays(20000, 6);
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(any[i].triangle == PRELIGHT_NO_TRIANGLE, closest[i].triangle == PRELIGHT_NO_TRIANGLE)
        << "ray " << i;
    found += closest[i].triangle != PRELIGHT_NO_TRIANGLE;
  }
  EXPECT_GT(found, rays.size() / 10);
  EXPECT_LT(found, rays.size());
}

TEST_P(TracerTest, AnyHit_LimitedDistance_IgnoresWhatIsBeyond) {
  Tracer tracer = tracerOf(test::ground(4, 1.0f));
  const std::vector<Ray> rays{limitedRay({0.1f, 1, 0.1f}, {0, -1, 0}, 0.999f),
                              limitedRay({0.1f, 1, 0.1f}, {0, -1, 0}, 1.001f)};
  const auto hits = tracer.traceAny(rays);
  EXPECT_EQ(hits[0].triangle, PRELIGHT_NO_TRIANGLE);
  EXPECT_NE(hits[1].triangle, PRELIGHT_NO_TRIANGLE);
}

TEST_P(TracerTest, ClosestHit_SourceTriangle_IsSkipped) {
  Tracer tracer = tracerOf(test::sceneOf(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, {{0, 1, 2}, {3, 4, 5}}));
  const std::vector<Ray> rays{limitedRay({0.2f, 0.2f, 1}, {0, 0, -1}),
                              limitedRay({0.2f, 0.2f, 1}, {0, 0, -1}, unlimited, 0u)};
  const auto hits = tracer.traceClosest(rays);
  EXPECT_EQ(hits[0].triangle, 0u);
  EXPECT_EQ(hits[1].triangle, 1u);
}

// From inside a closed mesh every ray must hit, also those aimed exactly at vertices and along edges.
TEST_P(TracerTest, ClosedMesh_RaysAtVerticesAndEdges_NeverLeak) {
  for (const float scale : {1e-3f, 1.0f, 1e4f}) {
    const CompiledScene scene = test::sphere(24, scale, glm::vec3(0.25f, -0.5f, 0.125f) * scale);
    Tracer tracer = tracerOf(scene);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Ray> rays;
    for (int repeat = 0; repeat < 20; ++repeat)
      for (const auto& t : scene.triangles) {
        const glm::vec3 from =
            scale * (glm::vec3(0.25f, -0.5f, 0.125f) + 0.5f * unit(random) * test::randomDirection(random));
        const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y];
        rays.push_back(limitedRay(from, a - from));
        rays.push_back(limitedRay(from, a + unit(random) * (b - a) - from));
      }
    const auto closest = tracer.traceClosest(rays);
    const auto any = tracer.traceAny(rays);
    std::size_t leaks = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      leaks += closest[i].triangle == PRELIGHT_NO_TRIANGLE || any[i].triangle == PRELIGHT_NO_TRIANGLE;
    EXPECT_EQ(leaks, 0u) << "of " << rays.size() << " rays at scale " << scale;
  }
}

// Axis-parallel rays run in the planes of boxes and of the mesh itself.
TEST_P(TracerTest, ClosedBox_AxisParallelRaysInFacePlanes_NeverLeak) {
  const CompiledScene scene = test::box(8, {-1, -1, -1}, {1, 1, 1}, true);
  Tracer tracer = tracerOf(scene);
  std::vector<Ray> rays;
  for (int i = -7; i <= 7; ++i)
    for (int j = -7; j <= 7; ++j)
      for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
          glm::vec3 from(0), direction(0);
          from[(axis + 1) % 3] = static_cast<float>(i) / 8.0f;
          from[(axis + 2) % 3] = static_cast<float>(j) / 8.0f;
          direction[axis] = sign;
          rays.push_back(limitedRay(from, direction));
        }
  const auto hits = tracer.traceClosest(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_NE(hits[i].triangle, PRELIGHT_NO_TRIANGLE) << "ray " << i;
    EXPECT_FLOAT_EQ(hits[i].t, 1.0f);
  }
}

TEST_P(TracerTest, ClosestHit_OddGeometry_StaysFinite) {
  CompiledScene scene = test::sceneOf({{0, 0, 0},
                                       {1, 0, 0},
                                       {2, 0, 0},
                                       {0, 0, 1},
                                       {1e-20f, 1e-20f, 1},
                                       {0, 1e-20f, 1},
                                       {1e18f, 0, -2},
                                       {-1e18f, 1e18f, -2},
                                       {-1e18f, -1e18f, -2}},
                                      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  Tracer tracer = tracerOf(scene);
  auto rays = randomRays(2000, 8);
  rays.push_back(limitedRay({0, 0, 0}, {0, 0, -1}));
  rays.push_back(limitedRay({0, 0, 0}, {1, 0, 0}));
  rays.push_back(limitedRay({0, 0, 5}, {1e-30f, 0, -1}));
  const auto hits = tracer.traceClosest(rays);
  for (const Hit& hit : hits)
    EXPECT_TRUE(std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v));
  EXPECT_EQ(hits[2000].triangle, 2u) << "the huge triangle, beside those of no area";
  EXPECT_NEAR(hits[2000].t, 2.0f, 1e-5f);
}

TEST_P(TracerTest, AlphaMask_TransparentTexels_LetRaysThrough) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  scene.texCoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.images = {{"half", 2, 1, {255, 255, 255, 0, 255, 255, 255, 255}}};
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].alphaCutoff = 0.5f;
  scene.materials[0].baseColorTexture.wrapS = scene.materials[0].baseColorTexture.wrapT =
      WrapMode::ClampToEdge;
  Tracer tracer = tracerOf(scene);
  const std::vector<Ray> rays{limitedRay({0.2f, 0.3f, 1}, {0, 0, -1}),
                              limitedRay({0.8f, 0.3f, 1}, {0, 0, -1})};
  for (const auto& hits : {tracer.traceClosest(rays), tracer.traceAny(rays)}) {
    EXPECT_EQ(hits[0].triangle, PRELIGHT_NO_TRIANGLE);
    EXPECT_NE(hits[1].triangle, PRELIGHT_NO_TRIANGLE);
  }
}

TEST_P(TracerTest, SingleTriangle_IsHit) {
  Tracer tracer = tracerOf(test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  const std::vector<Ray> rays{limitedRay({0.25f, 0.25f, 1}, {0, 0, -2}),
                              limitedRay({0.75f, 0.75f, 1}, {0, 0, -1})};
  const auto hits = tracer.traceClosest(rays);
  EXPECT_EQ(hits[0].triangle, 0u);
  EXPECT_FLOAT_EQ(hits[0].t, 0.5f);
  EXPECT_EQ(hits[1].triangle, PRELIGHT_NO_TRIANGLE);
}

// Rays that leave a few points, 40 directions each: groups of one point, of two, and one that is not full.
std::vector<Ray> raysFromPoints(std::size_t points, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-0.2f, 1.2f);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < points; ++i) {
    const glm::vec3 origin(unit(random), unit(random), unit(random));
    for (int k = 0; k < 40; ++k)
      rays.push_back(limitedRay(origin, test::randomDirection(random), k % 5 == 0 ? 0.3f : unlimited));
  }
  return rays;
}

bool operator==(const Hit& a, const Hit& b) {
  return a.t == b.t && a.triangle == b.triangle && a.u == b.u && a.v == b.v;
}

TEST_P(TracerTest, RaysOfOnePoint_HitWhatTheyHitInAnyOtherCompany) {
  for (const float size : {0.03f, 0.4f}) {
    const CompiledScene scene = test::randomSoup(4000, size, 12);
    Tracer tracer = tracerOf(scene);
    const auto rays = raysFromPoints(201, 13);
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(14));
    std::vector<Ray> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    const auto together = tracer.traceClosest(rays), apart = tracer.traceClosest(shuffled);
    const auto togetherAny = tracer.traceAny(rays), apartAny = tracer.traceAny(shuffled);
    std::size_t found = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(apart[i] == together[order[i]]) << "ray " << order[i];
      ASSERT_TRUE(apartAny[i] == togetherAny[order[i]]) << "ray " << order[i];
      ASSERT_EQ(apart[i].triangle == PRELIGHT_NO_TRIANGLE, apartAny[i].triangle == PRELIGHT_NO_TRIANGLE);
      found += apart[i].triangle != PRELIGHT_NO_TRIANGLE;
    }
    EXPECT_GT(found, rays.size() / 100);
    EXPECT_LT(found, rays.size());
    for (std::size_t i = 0; i < rays.size(); i += 7) expectSameHit(scene, rays[i], together[i]);
  }
}

TEST_P(TracerTest, PortableKernels_HitTheSame) {
  DeviceOptions options;
  options.portableKernels = true;
  const Device portable = Device::open(options);
  const CompiledScene scene = test::randomSoup(3000, 0.1f, 21);
  auto rays = raysFromPoints(50, 22);
  const auto loose = randomRays(2000, 23);
  rays.insert(rays.end(), loose.begin(), loose.end());
  const auto expected = tracerOf(scene).traceClosest(rays);
  const auto hits = Tracer(scene, portable, GetParam()).traceClosest(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(hits[i] == expected[i]) << "ray " << i;
}

TEST_P(TracerTest, NotANumber_InARay_HitsNothingAndEnds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Tracer tracer = tracerOf(test::randomSoup(500, 0.3f, 4));
  std::vector<Ray> rays;
  for (int k = 0; k < 20; ++k) rays.push_back(limitedRay({nan, 0, 0}, {0, 0, 1}));
  for (int k = 0; k < 20; ++k)
    rays.push_back(limitedRay({0.5f, 0.5f, 0.5f}, {nan, k % 2 ? 1.0f : -1.0f, nan}));
  for (int k = 0; k < 20; ++k) rays.push_back(limitedRay({0.5f, unlimited, 0.5f}, {1, 1, 1}));
  for (int k = 0; k < 20; ++k) rays.push_back(limitedRay({0.5f, 0.5f, 0.5f}, {0, 0, 0}));
  for (const auto& hits : {tracer.traceClosest(rays), tracer.traceAny(rays)})
    for (const Hit& hit : hits) EXPECT_EQ(hit.triangle, PRELIGHT_NO_TRIANGLE);
}

TEST_P(TracerTest, ClosestHit_AnyBuildQuality_IsTheSame) {
  const CompiledScene scene = test::randomSoup(3000, 0.3f, 21);
  const auto rays = randomRays(20000, 22);
  const auto hitsOf = [&](BuildQuality quality) {
    return Tracer(scene, test::sharedDevice(), GetParam(), quality).traceClosest(rays);
  };
  const auto high = hitsOf(BuildQuality::High);
  for (const auto& hits : {hitsOf(BuildQuality::Fast), hitsOf(BuildQuality::Balanced)})
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(hits[i].triangle, high[i].triangle) << "ray " << i;
      ASSERT_EQ(hits[i].t, high[i].t) << "ray " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, TracerTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

TEST_P(TracerTest, TreeThatStartsAtTheFirstRay_IsTheSame) {
  const CompiledScene scene = test::randomSoup(700, 0.3f, 3);
  Tracer late(scene, test::sharedDevice(), GetParam(), BuildQuality::High, TreeLevels::Automatic,
              TreeStart::AtFirstRay);
  EXPECT_EQ(late.bvhBytes(), 0u);
  Tracer atOnce = tracerOf(scene);
  const auto rays = randomRays(500, 5);
  const auto hits = late.traceClosest(rays), expected = atOnce.traceClosest(rays);
  EXPECT_EQ(late.bvhBytes(), atOnce.bvhBytes());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, expected[i].triangle);
    EXPECT_EQ(hits[i].t, expected[i].t);
  }
}

TEST(WideBvh, CoincidentTriangles_StackStaysBounded) {
  const CompiledScene scene =
      test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::uvec3>(20000, {0, 1, 2}));
  EXPECT_LE(makeWideBvh(buildBvh(scene), scene).stackSize, 256u);
}

}  // namespace
}  // namespace prelight
