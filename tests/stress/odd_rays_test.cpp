// Legal but rare rays, and invalid rays.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "gpu/tracer.h"
#include "stress/hit_bounds.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

class OddRaysTest : public ::testing::TestWithParam<BvhLayout> {
 protected:
  static Tracer tracerOf(const CompiledScene& scene) { return {scene, test::sharedDevice(), GetParam()}; }

  static bool isMiss(const Hit& hit) { return hit.triangle == PRELIGHT_NO_TRIANGLE; }

  static void expectFinite(const Hit& hit) {
    EXPECT_TRUE(std::isfinite(hit.t) && std::isfinite(hit.u) && std::isfinite(hit.v))
        << hit.t << ' ' << hit.u << ' ' << hit.v;
  }
};

std::vector<Ray> raysIntoSoup(std::size_t count) {
  test::Counter random(11);
  std::vector<Ray> rays;
  glm::vec3 from(0);
  for (std::size_t i = 0; i < count; ++i) {
    // The second half of the rays comes in bundles of 16 from one point.
    if (i < count / 2 || i % 16 == 0) from = {random.uniform(), random.uniform(), random.uniform()};
    rays.push_back(test::makeRay(from, random.direction()));
  }
  return rays;
}

// t is measured in lengths of the direction, and a power of two rounds nothing.
TEST_P(OddRaysTest, DirectionTimesPowerOfTwo_GivesTheSameHitExactly) {
  const CompiledScene scene = test::randomSoup(3000, 0.1f, 12);
  Tracer tracer = tracerOf(scene);
  const auto rays = raysIntoSoup(5000);
  const auto plain = tracer.traceClosest(rays);
  for (const int exponent : {-100, -70, -30, 30, 70, 100}) {
    auto scaled = rays;
    for (auto& ray : scaled)
      for (float& d : ray.direction) d = std::ldexp(d, exponent);
    const auto hits = tracer.traceClosest(scaled);
    const auto any = tracer.traceAny(scaled);
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      different += hits[i].triangle != plain[i].triangle || hits[i].t != std::ldexp(plain[i].t, -exponent) ||
                   hits[i].u != plain[i].u || hits[i].v != plain[i].v || isMiss(any[i]) != isMiss(plain[i]);
    EXPECT_EQ(different, 0u) << "2^" << exponent;
  }
}

// Rays from points on faces, edges and corners of a box, and inside it, along and within its planes.
TEST_P(OddRaysTest, RaysWithinPlanesOfAClosedBox_HitAtItsWalls) {
  constexpr int cells = 4;
  const CompiledScene scene = test::box(cells, {-1, -1, -1}, {1, 1, 1}, true);
  Tracer tracer = tracerOf(scene);
  std::vector<Ray> rays;
  const std::array<float, 5> places{-1.0f, -0.5f, 0.0f, 0.5f, 1.0f};
  for (const float x : places)
    for (const float y : places)
      for (const float z : places)
        for (int d = 0; d < 27; ++d) {
          if (d == 13) continue;
          const glm::vec3 direction(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
          rays.push_back(test::makeRay({x, y, z}, direction));
          // Repeats the ray without exact zeros.
          rays.push_back(test::makeRay({x, y, z}, direction + glm::vec3(1e-30f, -1e-30f, 1e-30f)));
        }
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    // A ray that starts on a wall may go outwards or along it: it hits the wall at t = 0, or nothing.
    bool leaves = false;
    for (int axis = 0; axis < 3; ++axis)
      leaves =
          leaves || (std::abs(ray.origin[axis]) == 1.0f && ray.origin[axis] * ray.direction[axis] > 0.0f);
    EXPECT_EQ(isMiss(closest[i]), isMiss(any[i]));
    expectFinite(closest[i]);
    if (!leaves) {
      EXPECT_FALSE(isMiss(closest[i])) << "ray " << i;
    }
    EXPECT_EQ(test::disagreement(scene, ray, closest[i], any[i]), "") << "ray " << i;
  }
}

TEST_P(OddRaysTest, RaysFromVerticesEdgesAndFacesOfASphere_InwardsHit) {
  const CompiledScene scene = test::sphere(16, 1.0f, {0.3f, 0.1f, -0.2f});
  Tracer tracer = tracerOf(scene);
  test::Counter random(13);
  std::vector<Ray> rays;
  for (const auto& t : scene.triangles)
    for (int kind = 0; kind < 6; ++kind) {
      const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z];
      const float u = random.uniform(), v = random.uniform() * (1.0f - u);
      const glm::vec3 from = kind < 2 ? a : (kind < 4 ? a + u * (b - a) : a + u * (b - a) + v * (c - a));
      const glm::vec3 middle(0.3f, 0.1f, -0.2f);
      rays.push_back(test::makeRay(from, middle + 0.8f * random.uniform() * random.direction() - from));
    }
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_FALSE(isMiss(closest[i]) || isMiss(any[i])) << "ray " << i;
    EXPECT_EQ(test::disagreement(scene, rays[i], closest[i], any[i]), "") << "ray " << i;
  }
}

TEST_P(OddRaysTest, HitAtTheLimit_CountsAndBeyondDoesNot) {
  Tracer tracer = tracerOf(test::ground(4, 1.0f));
  const glm::vec3 above(0.1f, 1, 0.2f), on(0.1f, 0, 0.2f), down(0, -1, 0);
  struct Case {
    glm::vec3 origin;
    float tMax;
    bool hit;
  };
  const std::vector<Case> cases{{above, 1.0f, true},
                                {above, std::nextafter(1.0f, 0.0f), false},
                                {above, std::nextafter(1.0f, 2.0f), true},
                                {above, std::numeric_limits<float>::max(), true},
                                {above, infinity, true},
                                {above, 0.0f, false},
                                {above, -1.0f, false},
                                {above, -infinity, false},
                                {on, 0.0f, true},
                                {on, 1.0f, true},
                                {on, -0.0f, true},
                                {on, -1e-30f, false}};
  std::vector<Ray> rays;
  for (const auto& c : cases) rays.push_back(test::makeRay(c.origin, down, c.tMax));
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(!isMiss(closest[i]), cases[i].hit) << "case " << i;
    EXPECT_EQ(!isMiss(any[i]), cases[i].hit) << "case " << i;
    EXPECT_EQ(closest[i].t, cases[i].hit ? cases[i].origin.y : 0.0f) << "case " << i;
  }
}

TEST_P(OddRaysTest, NotANumberAndInfinity_MissOrHitFinitely) {
  const CompiledScene scene = test::randomSoup(2000, 0.1f, 14);
  Tracer tracer = tracerOf(scene);
  const std::array<float, 8> values{notANumber, -notANumber, infinity, -infinity, 0.0f, 0.5f, -1e-40f, 3e38f};
  std::vector<Ray> rays;
  test::Counter random(15);
  for (int i = 0; i < 20000; ++i) {
    const auto value = [&] { return values[random.below(values.size())]; };
    const glm::vec3 origin(value(), value(), value()), direction(value(), value(), value());
    rays.push_back(test::makeRay(origin, direction, random.below(2) == 0 ? infinity : value()));
  }
  rays.push_back(test::makeRay({0.5f, 0.5f, 0.5f}, {0, 0, 0}));
  rays.push_back(test::makeRay({notANumber, notANumber, notANumber}, {notANumber, notANumber, notANumber}));
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    expectFinite(closest[i]);
    expectFinite(any[i]);
    EXPECT_TRUE(isMiss(closest[i]) || closest[i].triangle < scene.triangleCount());
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts, OddRaysTest, ::testing::Values(BvhLayout::Wide, BvhLayout::Narrow),
                         [](const auto& test) { return test.param == BvhLayout::Wide ? "Wide" : "Narrow"; });

}  // namespace
}  // namespace prelight
