#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "gpu/tracer.h"
#include "scene/instancing.h"
#include "support/devices.h"
#include "support/instanced_scene.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

constexpr float infinity = std::numeric_limits<float>::infinity();

Ray rayOf(const glm::vec3& o, const glm::vec3& d, std::uint32_t source = PRELIGHT_NO_TRIANGLE) {
  return {{o.x, o.y, o.z}, source, {d.x, d.y, d.z}, infinity};
}

/// Random rays; every other run of 16 leaves one point, as rays of a receiver do.
std::vector<Ray> raysIn(float half, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-half, half);
  std::vector<Ray> rays;
  glm::vec3 origin(0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 32 >= 16 || i % 32 == 0) origin = {unit(random), unit(random), unit(random)};
    rays.push_back(rayOf(origin, test::randomDirection(random)));
  }
  return rays;
}

bool nearEdge(const Hit& hit) { return std::min({hit.u, hit.v, 1.0f - hit.u - hit.v}) < 1e-3f; }

/// Expects the same triangles unless one of the hits is within rounding of an edge. The distance from the
/// triangle's plane must always agree; the distance along the ray may differ more, the more the ray grazes
/// the triangle.
void expectSame(const CompiledScene& scene, const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                const std::vector<Hit>& flat, float half) {
  std::size_t found = 0, otherwise = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool hit = hits[i].triangle != PRELIGHT_NO_TRIANGLE;
    found += hit;
    if (hits[i].triangle != flat[i].triangle) {
      EXPECT_TRUE(nearEdge(hits[i]) || nearEdge(flat[i])) << "ray " << i;
      ++otherwise;
      continue;
    }
    if (!hit) continue;
    const glm::dvec3 normal = glm::normalize(geometricNormal(scene, hits[i].triangle));
    const double cosine = std::abs(
        glm::dot(normal, glm::dvec3(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2])));
    EXPECT_NEAR(cosine * hits[i].t, cosine * flat[i].t, 1e-6 * half) << "ray " << i;
    EXPECT_NEAR(hits[i].u, flat[i].u, 1e-3f) << "ray " << i;
    EXPECT_NEAR(hits[i].v, flat[i].v, 1e-3f) << "ray " << i;
  }
  EXPECT_GT(found, hits.size() / 50);
  EXPECT_LT(otherwise, hits.size() / 200);
}

class InstancesTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  Tracer tracerOf(const CompiledScene& scene, TreeLevels levels) {
    return Tracer(scene, test::sharedDevice(), GetParam(), BuildQuality::High, levels);
  }
};

TEST_P(InstancesTest, ManyDrawings_HitsAreThoseOfOneTree) {
  for (const std::size_t count : {3u, 60u}) {
    const float half = count == 3 ? 1.0f : 4.0f;
    const CompiledScene scene = test::compiled(test::strewnScene(count, half, 3));
    Tracer tracer = tracerOf(scene, TreeLevels::Two), flat = tracerOf(scene, TreeLevels::One);
    EXPECT_GE(tracer.instanceCount(), 2 * count / 3);
    EXPECT_EQ(flat.instanceCount(), 0u);
    const auto rays = raysIn(1.2f * half, 20000, 4);
    expectSame(scene, rays, tracer.traceClosest(rays), flat.traceClosest(rays), 5.0f);
  }
}

TEST_P(InstancesTest, AnyHit_IsThereWhenClosestIs) {
  const CompiledScene scene = test::compiled(test::strewnScene(40, 4.0, 6));
  Tracer tracer = tracerOf(scene, TreeLevels::Two);
  const auto rays = raysIn(5.0f, 20000, 7);
  const auto closest = tracer.traceClosest(rays), any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    ASSERT_EQ(any[i].triangle, closest[i].triangle == PRELIGHT_NO_TRIANGLE ? PRELIGHT_NO_TRIANGLE : 0u) << i;
}

TEST_P(InstancesTest, PartOfTheTriangles_HitsAreThoseOfOneTree) {
  const CompiledScene scene = test::compiled(test::strewnScene(30, 3.0, 5));
  // The range cuts through an instance, whose remaining triangles belong to no instance.
  std::vector<std::uint32_t> part;
  for (std::uint32_t t = scene.triangleCount() / 3 + 50; t < scene.triangleCount(); ++t) part.push_back(t);
  const Tracer whole = tracerOf(scene, TreeLevels::Two), wholeFlat = tracerOf(scene, TreeLevels::One);
  Tracer tracer(whole, scene, part), flat(wholeFlat, scene, part);
  EXPECT_GT(tracer.instanceCount(), 10u);
  EXPECT_LT(tracer.instanceCount(), whole.instanceCount());
  const auto rays = raysIn(3.5f, 10000, 6);
  expectSame(scene, rays, tracer.traceClosest(rays), flat.traceClosest(rays), 5.0f);
}

/// The scene with some instances moved, as code that moves objects leaves it.
CompiledScene moved(CompiledScene scene, std::size_t firstInstance, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (std::size_t i = firstInstance; i < firstInstance + count; ++i) {
    const glm::dmat4 motion = test::placedAtRandom(random, 1.0);
    CompiledInstance& instance = scene.instances[i];
    instance.toWorld = motion * instance.toWorld;
    for (std::uint32_t v = 0; v < scene.shapes[instance.shape].vertexCount; ++v) {
      glm::vec3& p = scene.positions[instance.firstVertex + v];
      p = glm::vec3(glm::dvec3(motion * glm::dvec4(glm::dvec3(p), 1.0)));
    }
  }
  return scene;
}

TEST_P(InstancesTest, MovedDrawings_AreHitWhereTheyAre) {
  const CompiledScene before = test::compiled(test::strewnScene(30, 3.0, 8));
  const CompiledScene after = moved(before, 4, 9, 9);
  std::vector<std::uint32_t> moving;
  for (std::size_t i = 4; i < 13; ++i)
    for (std::uint32_t t = 0; t < before.shapes[before.instances[i].shape].triangleCount; ++t)
      moving.push_back(before.instances[i].firstTriangle + t);
  Tracer tracer = tracerOf(before, TreeLevels::Two);
  tracer.separate(before, moving);
  const auto rays = raysIn(3.5f, 10000, 10);
  const auto hitsBefore = tracer.traceClosest(rays);
  const std::size_t bytes = tracer.bvhBytes();
  tracer.follow(after);
  EXPECT_EQ(tracer.bvhBytes(), bytes);
  const auto hits = tracer.traceClosest(rays), expected = tracerOf(after, TreeLevels::One).traceClosest(rays);
  expectSame(after, rays, hits, expected, 5.0f);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) changed += hitsBefore[i].triangle != hits[i].triangle;
  EXPECT_GT(changed, rays.size() / 50);
}

TEST_P(InstancesTest, SourceTriangle_IsSkippedInItsInstanceAlone) {
  Scene scene;
  scene.meshes = {test::meshOf(test::ground(4, 1.0f))};
  for (const double height : {0.0, -1.0})
    scene.meshNodes.push_back({0, "floor", 0, {glm::translate(glm::dmat4(1.0), {0.0, height, 0.0})}});
  const CompiledScene compiled = test::compiled(scene);
  Tracer tracer = tracerOf(compiled, TreeLevels::Two);
  ASSERT_EQ(tracer.instanceCount(), 2u);
  const std::vector<Ray> ray{rayOf({0.3f, 1.5f, 0.1f}, {0, -1, 0})};
  const Hit first = tracer.traceClosest(ray)[0];
  ASSERT_LT(first.triangle, 32u);
  const std::vector<Ray> further{rayOf({0.3f, 1.5f, 0.1f}, {0, -1, 0}, first.triangle)};
  const Hit second = tracer.traceClosest(further)[0];
  EXPECT_EQ(second.triangle, first.triangle + 32);
  EXPECT_FLOAT_EQ(second.t, 2.0f);
}

// From inside a closed shape every ray must hit it, wherever it stands.
TEST_P(InstancesTest, ClosedShape_RaysAtVerticesAndEdges_NeverLeak) {
  std::mt19937 random(11);
  for (const double distance : {0.01, 3.0, 300.0}) {
    Scene scene;
    scene.meshes = {test::meshOf(test::sphere(16, 1.0f, {}))};
    for (int i = 0; i < 2; ++i)
      scene.meshNodes.push_back({0, "ball", 0, {test::placedAtRandom(random, distance)}});
    const CompiledScene compiled = test::compiled(scene);
    Tracer tracer = tracerOf(compiled, TreeLevels::Two);
    ASSERT_EQ(tracer.instanceCount(), 2u);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Ray> rays;
    const CompiledInstance& instance = compiled.instances[1];
    const glm::vec3 centre(instance.toWorld[3]);
    for (std::uint32_t i = 0; i < compiled.shapes[0].triangleCount; ++i) {
      const glm::uvec3 t = compiled.triangles[instance.firstTriangle + i];
      const glm::vec3 a = compiled.positions[t.x], b = compiled.positions[t.y];
      const glm::vec3 from = centre + 0.5f * unit(random) * test::randomDirection(random);
      for (int repeat = 0; repeat < 16; ++repeat) {
        rays.push_back(rayOf(from, a - from));
        rays.push_back(rayOf(from, a + unit(random) * (b - a) - from));
      }
    }
    std::size_t leaks = 0;
    for (const Hit& hit : tracer.traceClosest(rays)) leaks += hit.triangle == PRELIGHT_NO_TRIANGLE;
    EXPECT_EQ(leaks, 0u) << "of " << rays.size() << " at " << distance;
  }
}

TEST_P(InstancesTest, AlphaMaskAndVertexColors_AreThoseOfTheShape) {
  Scene scene = test::strewnScene(30, 3.0, 12);
  std::mt19937 random(13);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Material masked;
  masked.alphaMode = AlphaMode::Mask;
  masked.alphaCutoff = 0.5f;
  masked.baseColorTexture.image = 0;
  scene.materials = {masked};
  Image holes{"holes", 8, 8, {}};
  for (int i = 0; i < 64; ++i) {
    const auto alpha = static_cast<std::uint8_t>(i % 3 == 0 ? 0 : 255);
    holes.rgba.insert(holes.rgba.end(), {200, 200, 200, alpha});
  }
  scene.images = {holes};
  for (const std::size_t mesh : {0u, 2u}) {
    Primitive& primitive = scene.meshes[mesh].primitives[0];
    primitive.material = 0;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      primitive.texCoords0.emplace_back(2.0f * unit(random), 2.0f * unit(random));
      primitive.colors.emplace_back(1.0f, 1.0f, 1.0f, 0.4f + 0.6f * unit(random));
    }
  }
  const CompiledScene compiled = test::compiled(scene);
  Tracer tracer = tracerOf(compiled, TreeLevels::Two), flat = tracerOf(compiled, TreeLevels::One);
  const auto rays = raysIn(3.5f, 20000, 14);
  const auto hits = tracer.traceClosest(rays), expected = flat.traceClosest(rays);
  // Near an edge of a hole, too, rounding may decide a hit either way.
  std::size_t same = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) same += hits[i].triangle == expected[i].triangle;
  EXPECT_GT(same, rays.size() - rays.size() / 200);
  Scene opaque = scene;
  opaque.materials[0].alphaMode = AlphaMode::Opaque;
  const auto whole = tracerOf(test::compiled(opaque), TreeLevels::Two).traceClosest(rays);
  std::size_t through = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) through += hits[i].triangle != whole[i].triangle;
  EXPECT_GT(through, rays.size() / 100);
}

TEST_P(InstancesTest, Shapes_TakeTheirMemoryOnce) {
  const CompiledScene few = test::compiled(test::strewnScene(16, 4.0, 1)),
                      many = test::compiled(test::strewnScene(400, 12.0, 1));
  const Tracer fewTracer = tracerOf(few, TreeLevels::Two), manyTracer = tracerOf(many, TreeLevels::Two);
  EXPECT_LE(manyTracer.bvhBytes(), fewTracer.bvhBytes() + 400u * 300u);
  EXPECT_LE(manyTracer.scene().surface().bytes(), fewTracer.scene().surface().bytes() + 400u * 16u);
  EXPECT_LT(8 * manyTracer.bvhBytes(), tracerOf(many, TreeLevels::One).bvhBytes());
}

TEST_P(InstancesTest, FewTriangles_StayInOneTree) {
  const CompiledScene scene = test::compiled(test::strewnScene(30, 3.0, 8));
  ASSERT_FALSE(chooseInstancing(scene).used);
  EXPECT_EQ(tracerOf(scene, TreeLevels::Automatic).instanceCount(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Layouts, InstancesTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow));

}  // namespace
}  // namespace prelight
