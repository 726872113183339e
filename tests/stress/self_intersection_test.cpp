// Rays that leave a surface must neither hit it again nor miss the surfaces that meet it. Receivers are
// placed as in a bake, at every scale and place.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "gpu/tracer.h"
#include "receivers/surface_sampler.h"
#include "stress/closed_meshes.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr std::uint64_t usualRays = 150'000;  // Per scene.

struct Move {
  double scale;
  glm::dvec3 offset;
};

const std::vector<Move>& moves() {
  static const std::vector<Move> all{{1, {0, 0, 0}},        {1e-6, {0, 0, 0}}, {1e6, {0, 0, 0}},
                                     {1, {1e6, -1e6, 5e5}}, {1e-6, {1, 2, 3}}, {1e3, {1e6, 1e6, -1e6}}};
  return all;
}

glm::dmat4 transformOf(const Move& move) {
  return glm::scale(glm::translate(glm::dmat4(1.0), move.offset), glm::dvec3(move.scale)) *
         glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(0.3, 1, -0.4)));
}

/// A mesh as a loaded scene of one object, compiled after `move`.
CompiledScene compiledMesh(const CompiledScene& mesh, const Move& move) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].primitives.resize(1);
  scene.meshes[0].primitives[0].positions = mesh.positions;
  scene.meshes[0].primitives[0].triangles = mesh.triangles;
  scene.meshNodes = {{0, "mesh", 0, {transformOf(move)}}};
  Warnings warnings;
  return compileScene(scene, warnings);
}

class SelfIntersectionTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  // Rays over the whole hemisphere of receivers on every triangle, as a bake casts them.
  static std::vector<device::Ray> raysFromReceivers(const CompiledScene& scene, std::uint64_t count) {
    constexpr std::uint64_t raysEach = 8;
    SurfaceSampler sampler(scene, 1, Side::Front);
    test::Counter random(41);
    std::vector<device::Ray> rays;
    sampler.pass(double(count / raysEach), raysEach, [&](const SurfaceSample&, const device::Receiver& r) {
      const glm::vec3 p(r.position[0], r.position[1], r.position[2]);
      const glm::vec3 g(r.geometricNormal[0], r.geometricNormal[1], r.geometricNormal[2]);
      for (std::uint64_t i = 0; i < raysEach;) {
        glm::vec3 d = random.direction();
        // Makes every other ray graze the surface.
        if (i % 2 == 0) d -= 0.99f * glm::dot(d, g) * g;
        if (glm::dot(d, g) <= 0.0f) continue;
        rays.push_back(test::makeRay(p, d, std::numeric_limits<float>::max(), r.triangle));
        ++i;
      }
    });
    return rays;
  }

  // Number of hits, and number of rays, from a scene's receivers.
  static std::pair<std::uint64_t, std::uint64_t> hitsAndRays(const CompiledScene& scene) {
    Tracer tracer(scene, test::sharedDevice(), GetParam());
    const auto rays = raysFromReceivers(scene, test::stressRays(usualRays));
    std::uint64_t hits = 0;
    for (const auto& hit : tracer.traceClosest(rays)) hits += hit.triangle != PRELIGHT_NO_TRIANGLE;
    return {hits, rays.size()};
  }
};

TEST_P(SelfIntersectionTest, ConvexBodiesSeenFromOutside_NeverHitThemselves) {
  const std::vector<std::pair<std::string, CompiledScene>> bodies{
      {"sphere", test::sphere(24, 1.0f, {0, 0, 0})},
      {"box", test::box(8, {-1, -1, -1}, {1, 1, 1}, false)},
      {"slab", test::box(8, {-1, -1e-3f, -1}, {1, 1e-3f, 1}, false)}};
  for (const auto& [name, body] : bodies)
    for (const Move& move : moves()) {
      const auto [hits, rays] = hitsAndRays(compiledMesh(body, move));
      EXPECT_GT(rays, usualRays / 2);
      EXPECT_EQ(hits, 0u) << name << " at scale " << move.scale << ", of " << rays;
    }
}

TEST_P(SelfIntersectionTest, ClosedRoomsSeenFromInside_NeverLetRaysOut) {
  for (const Move& move : moves()) {
    const CompiledScene room = compiledMesh(test::box(12, {-2, 0, -3}, {2, 2.5f, 3}, true), move);
    const auto [hits, rays] = hitsAndRays(room);
    EXPECT_EQ(rays - hits, 0u) << "at scale " << move.scale << ", of " << rays;
  }
}

// The scene is not recentred, so that floats are coarse there. The coordinates are exact, so the bodies stay
// convex.
TEST_P(SelfIntersectionTest, FarFromZeroWithoutRecentring_NeitherHitsNorEscapes) {
  for (const float offset : {0x1p10f, 0x1p15f, 0x1p20f}) {
    const glm::vec3 middle(offset, -offset, 0.5f * offset);
    const CompiledScene body = test::box(4, middle - 64.0f, middle + 64.0f, false);
    const auto [hits, rays] = hitsAndRays(body);
    EXPECT_EQ(hits, 0u) << "box at " << offset << ", of " << rays;
    const CompiledScene room = test::box(4, middle - 64.0f, middle + 64.0f, true);
    const auto [roomHits, roomRays] = hitsAndRays(room);
    EXPECT_EQ(roomRays - roomHits, 0u) << "room at " << offset << ", of " << roomRays;
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts, SelfIntersectionTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

Bake bakeMoved(const std::string& name, const glm::dmat4& transform) {
  BakeRequest request;
  request.nearLamps.shells = 0;  // lamps stay where they are
  request.ao = true;
  request.sh.order = 3;
  request.effort.rays = 512;
  Warnings warnings;
  const Scene scene = test::builtinScene(name, transform);
  const CompiledScene compiled = compileScene(scene, warnings);
  Progress progress;
  BakeReport report;
  return bakeScene(compiled, request, makePlan(scene, compiled, request), test::sharedDevice(), progress,
                   report);
}

double rmsDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * double(a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

// Powers of two round nothing: every result of a bake scales with them, to the last bit.
TEST(BakeOfMovedScene, ScaledByPowersOfTwo_IsTheSame) {
  const Bake plain = bakeMoved("rooms", glm::dmat4(1.0));
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Bake scaled = bakeMoved("rooms", glm::scale(glm::dmat4(1.0), glm::dvec3(scale)));
    EXPECT_EQ(scaled.ao, plain.ao) << scale;
    EXPECT_EQ(scaled.sh->coefficients, plain.sh->coefficients) << scale;
  }
}

// One seed casts the same rays from the same places except for rounding, so that noise cancels. Single rays
// that pass an edge on its other side remain. A leak, or a shadow of the surface on itself, would be visible.
TEST(BakeOfMovedScene, ScaledAndFarFromZero_AgreesButForSingleRays) {
  for (const std::string name : {"shapes", "rooms"}) {
    const Bake plain = bakeMoved(name, glm::dmat4(1.0));
    for (const Move& move : {Move{1e-6, {0, 0, 0}}, Move{1e6, {0, 0, 0}}, Move{1, {1e6, -1e6, 5e5}}}) {
      const Bake moved =
          bakeMoved(name, glm::scale(glm::translate(glm::dmat4(1.0), move.offset), glm::dvec3(move.scale)));
      ASSERT_EQ(moved.ao.size(), plain.ao.size());
      for (const float ao : moved.ao) ASSERT_TRUE(ao >= 0.0f && ao <= 1.0f);
      for (const float c : moved.sh->coefficients) ASSERT_TRUE(std::isfinite(c));
      EXPECT_LT(rmsDifference(moved.ao, plain.ao), 1e-3) << name << ' ' << move.scale << ' ' << move.offset.x;
      RecordProperty(name + "_" + std::to_string(move.scale) + "_" + std::to_string(move.offset.x),
                     std::to_string(rmsDifference(moved.ao, plain.ao)));
    }
  }
}

}  // namespace
}  // namespace prelight
