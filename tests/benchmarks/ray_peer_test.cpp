#include "benchmarks/peers/embree/ray_peer.h"

#include <gtest/gtest.h>

#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/ray_sets.h"
#include "oracle/brute_force.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

using device::Hit;
using device::Ray;

/// A number of rays that leaves the last packet incomplete, some of them too short to hit anything.
std::vector<Ray> someRays(const BenchmarkScene& scene) {
  std::vector<Ray> rays = cameraRays(scene, 1024);
  rays.resize(1003);
  for (std::size_t i = 0; i < rays.size(); i += 3) rays[i].tMax = 0.01f;
  return rays;
}

void expectExact(const CompiledScene& scene, const Ray& ray, const Hit& closest, const Hit& any,
                 const ::testing::Message& how) {
  const auto exact = reference::closestHit(scene, {ray.origin[0], ray.origin[1], ray.origin[2]},
                                           {ray.direction[0], ray.direction[1], ray.direction[2]},
                                           double(ray.tMax), ray.sourceTriangle);
  EXPECT_EQ(any.triangle != PRELIGHT_NO_TRIANGLE, exact.has_value()) << how;
  ASSERT_EQ(closest.triangle != PRELIGHT_NO_TRIANGLE, exact.has_value()) << how;
  if (!exact) return;
  EXPECT_EQ(closest.triangle, exact->triangle) << how;
  EXPECT_NEAR(closest.t, exact->t, 1e-5 * exact->t) << how;
  EXPECT_NEAR(closest.u, exact->u, 1e-3) << how;
  EXPECT_NEAR(closest.v, exact->v, 1e-3) << how;
}

TEST(EmbreePeer, HoweverItIsAsked_HitsWhatBruteForceHits) {
  const BenchmarkScene scene = makeDetailedRooms(1000);
  const std::unique_ptr<RayPeer> peer = makeEmbreePeer(scene.compiled, PeerQuality::Medium, 2);
  if (!peer) GTEST_SKIP() << "built without Embree";
  EXPECT_GT(peer->bytes(), 12u * scene.compiled.triangleCount());
  const std::vector<Ray> rays = someRays(scene);
  for (const int width : {1, 8, 16})
    for (const bool coherent : {false, true}) {
      std::vector<Hit> closest(rays.size()), any(rays.size());
      peer->trace(rays, closest, {false, width, coherent});
      peer->trace(rays, any, {true, width, coherent});
      for (std::size_t i = 0; i < rays.size(); ++i)
        expectExact(scene.compiled, rays[i], closest[i], any[i],
                    ::testing::Message() << width << ' ' << coherent);
    }
}

}  // namespace
}  // namespace prelight::benchmarks
