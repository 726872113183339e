// The same rays give the same hits on every OpenCL implementation, except where the standard leaves rounding
// open.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/self_test.h"
#include "gpu/tracer.h"
#include "portability/devices.h"
#include "scene/builtin/builtin.h"
#include "stress/closed_meshes.h"
#include "stress/hit_bounds.h"
#include "stress/rays.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

struct Difference {
  std::size_t anyHits = 0;    ///< Rays with an any hit on one device and none on another.
  std::size_t triangles = 0;  ///< Closest hits on different triangles.
  std::size_t distances = 0;  ///< Closest hits on the same triangle whose t, u, v differ in any bit.
  double largest = 0.0;       ///< Largest |t - t'| / t of hits on the same triangle.
};

std::vector<Ray> raysThrough(const CompiledScene& scene, std::size_t count) {
  test::Counter random(51);
  std::vector<Ray> rays;
  glm::vec3 from(0);
  for (std::size_t i = 0; i < count; ++i) {
    // The second half of the rays comes in bundles of 16 from one point.
    const glm::vec3 share(random.uniform(), random.uniform(), random.uniform());
    if (i < count / 2 || i % 16 == 0) from = glm::mix(scene.boundsMin, scene.boundsMax, share);
    const auto& t = scene.triangles[random.below(scene.triangles.size())];
    const bool atVertex = random.below(8) == 0;
    rays.push_back(test::makeRay(from, atVertex ? scene.positions[t.x] - from : random.direction()));
  }
  return rays;
}

class PortableHitsTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  void expectSameHits(const std::string& name, const CompiledScene& scene, const std::vector<Ray>& rays) {
    const auto& devices = test::allDevices();
    Tracer first(scene, devices[0], GetParam());
    const auto closest = first.traceClosest(rays), any = first.traceAny(rays);
    for (std::size_t d = 1; d < devices.size(); ++d) {
      SCOPED_TRACE(name + ": " + test::nameOf(devices[0]) + " and " + test::nameOf(devices[d]));
      Tracer other(scene, devices[d], GetParam());
      const auto otherClosest = other.traceClosest(rays), otherAny = other.traceAny(rays);
      Difference difference;
      for (std::size_t i = 0; i < rays.size(); ++i)
        compare(scene, rays[i], closest[i], otherClosest[i], any[i], otherAny[i], difference);
      RecordProperty("any_" + name, std::to_string(difference.anyHits));
      RecordProperty("triangles_" + name, std::to_string(difference.triangles));
      RecordProperty("distances_" + name, std::to_string(difference.distances));
      RecordProperty("largest_" + name, std::to_string(difference.largest * 0x1p24) + " ulp");
    }
  }

 private:
  // Compares two devices' hits of one ray. A division may be off by 2.5 ulp, and the shear is one. A
  // different triangle must be equally near within the bounds of both, and whether there is a hit may depend
  // on that alone.
  static void compare(const CompiledScene& scene, const Ray& ray, const Hit& a, const Hit& b, const Hit& anyA,
                      const Hit& anyB, Difference& difference) {
    difference.anyHits += anyA.triangle != anyB.triangle;
    EXPECT_EQ(test::disagreement(scene, ray, b, anyB), "");
    if (a.triangle == PRELIGHT_NO_TRIANGLE && b.triangle == PRELIGHT_NO_TRIANGLE) return;
    if (a.triangle == b.triangle) {
      difference.distances += a.t != b.t || a.u != b.u || a.v != b.v;
      if (a.t > 0.0f) difference.largest = std::max(difference.largest, std::abs(double(a.t) - b.t) / a.t);
      const test::Crossing c = test::crossingOf(scene, a.triangle, ray);
      EXPECT_NEAR(a.t, b.t, 2 * c.tError);
      EXPECT_NEAR(a.u, b.u, 2 * c.weightError);
      EXPECT_NEAR(a.v, b.v, 2 * c.weightError);
      return;
    }
    ++difference.triangles;
    // Rounding may decide the nearer of the two hits either way.
    const bool aNearer =
        b.triangle == PRELIGHT_NO_TRIANGLE || (a.triangle != PRELIGHT_NO_TRIANGLE && a.t <= b.t);
    const Hit& nearer = aNearer ? a : b;
    const Hit& farther = aNearer ? b : a;
    const test::Crossing c = test::crossingOf(scene, nearer.triangle, ray);
    const bool asFar =
        farther.triangle != PRELIGHT_NO_TRIANGLE && std::abs(nearer.t - farther.t) <= 4 * c.tError;
    EXPECT_TRUE(!c.certain() || asFar)
        << nearer.triangle << " at " << nearer.t << ", " << farther.triangle << " at " << farther.t;
  }
};

TEST_P(PortableHitsTest, BuiltinScenes_HitsAgree) {
  PRELIGHT_NEEDS_TWO_DEVICES();
  for (const auto& builtin : builtinScenes()) {
    Warnings warnings;
    const CompiledScene scene = compileScene(test::builtinScene(builtin.name), warnings);
    expectSameHits(builtin.name, scene, raysThrough(scene, 1000));
  }
}

TEST_P(PortableHitsTest, SoupAndSlivers_HitsAgree) {
  PRELIGHT_NEEDS_TWO_DEVICES();
  const CompiledScene soup = test::randomSoup(2000, 0.2f, 52);
  expectSameHits("soup", soup, raysThrough(soup, 3000));
  const CompiledScene slivers = test::withSlivers(test::sphere(8, 1.0f, {0, 0, 0}), 1e-5f);
  expectSameHits("slivers", slivers, raysThrough(slivers, 3000));
}

// The guarantee that bakes rely on must hold on every device, not only on the first.
TEST_P(PortableHitsTest, ClosedMeshes_NeverLeakOnAnyDevice) {
  PRELIGHT_NEEDS_TWO_DEVICES();
  const CompiledScene ball = test::sphere(24, 1.0f, {0.25f, -0.5f, 0.125f});
  const std::vector<test::ClosedMesh> meshes{test::closedMesh("sphere", ball),
                                             test::closedMesh("slivers", test::withSlivers(ball, 1e-6f)),
                                             test::closedMesh("needles", test::needles(600, 1e4f)),
                                             test::closedMesh("torus", test::torus(48, 24, 1.0f, 0.4f))};
  for (const Device& device : test::allDevices())
    for (const auto& mesh : meshes) {
      Tracer tracer(mesh.scene, device, GetParam());
      std::vector<Ray> rays;
      for (std::uint64_t i = 0; i < 100'000; ++i) rays.push_back(test::aimedRay(mesh, i, 53));
      std::size_t leaks = 0;
      const auto closest = tracer.traceClosest(rays), any = tracer.traceAny(rays);
      for (std::size_t i = 0; i < rays.size(); ++i)
        leaks += closest[i].triangle == PRELIGHT_NO_TRIANGLE || any[i].triangle == PRELIGHT_NO_TRIANGLE;
      EXPECT_EQ(leaks, 0u) << mesh.name << " on " << test::nameOf(device);
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, PortableHitsTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

TEST(PortableDevice, SelfTest_PassesOnEveryDevice) {
  PRELIGHT_NEEDS_TWO_DEVICES();
  for (const Device& device : test::allDevices())
    for (const auto& result : selfTest(device))
      EXPECT_TRUE(result.passed) << test::nameOf(device) << ": " << result.name << ": " << result.detail;
}

}  // namespace
}  // namespace prelight
