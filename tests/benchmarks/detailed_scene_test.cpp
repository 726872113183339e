#include "benchmarks/scenes/detailed_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/suites/tracing/ray_sets.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

using device::Hit;
using device::Ray;

std::size_t misses(const std::vector<Hit>& hits) {
  return static_cast<std::size_t>(std::count_if(
      hits.begin(), hits.end(), [](const Hit& hit) { return hit.triangle == PRELIGHT_NO_TRIANGLE; }));
}

TEST(DetailedRooms, OfAnySize_HaveAboutTheTrianglesThatWereAskedFor) {
  for (const double count : {1e3, 1e4, 1e5}) {
    const CompiledScene scene = makeDetailedRooms(static_cast<std::uint64_t>(count)).compiled;
    EXPECT_NEAR(scene.triangleCount() / count, 1.0, 0.15) << count;
    EXPECT_EQ(scene.droppedTriangles, 0u);
  }
}

TEST(DetailedRooms, MadeTwice_AreTheSame) {
  EXPECT_EQ(makeDetailedRooms(3000).compiled.positions, makeDetailedRooms(3000).compiled.positions);
}

TEST(DetailedRooms, SizeNames_AreShort) {
  EXPECT_EQ(sizeName(1000), "1k");
  EXPECT_EQ(sizeName(250000), "250k");
  EXPECT_EQ(sizeName(2000000), "2M");
}

TEST(RaySets, InClosedRooms_NearlyAllHitSomething) {
  const BenchmarkScene scene = makeDetailedRooms(5000);
  DeviceContext& device = test::sharedDevice().context();
  Tracer tracer(scene.compiled, test::sharedDevice());
  constexpr std::size_t count = 1u << 14;
  for (const std::vector<Ray>& rays : {bakeLaunches(scene.compiled, device, count, 256),
                                       cameraRays(scene, count), photonRays(scene, tracer, count)}) {
    EXPECT_NEAR(static_cast<double>(rays.size()), count, 256.0);
    // Objects reach through the outer walls here and there, and what is there looks out.
    EXPECT_LT(misses(RayBlocks(device, rays).hits(tracer, false)), rays.size() / 10);
  }
}

TEST(RaySets, Shuffled_AreTheSameRaysInAnotherOrder) {
  const BenchmarkScene scene = makeDetailedRooms(1000);
  const std::vector<Ray> rays = bakeRays(scene.compiled, test::sharedDevice().context(), 1u << 12, 64);
  const auto firsts = [](const std::vector<Ray>& some) {
    std::vector<float> values;
    for (const Ray& ray : some) values.push_back(ray.direction[0]);
    return values;
  };
  std::vector<float> before = firsts(rays), after = firsts(shuffled(rays));
  EXPECT_NE(before, after);
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace prelight::benchmarks
