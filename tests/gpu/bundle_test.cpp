// Rays that leave one point are traced together. Their hits must not depend on it, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "gpu/tracer.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

// Not a multiple of a group: the last group has rays of two pencils.
constexpr std::size_t raysOfPencil = 37;

Ray rayFrom(const glm::vec3& o, const glm::vec3& d, float tMax, std::uint32_t source) {
  return {{o.x, o.y, o.z}, source, {d.x, d.y, d.z}, tMax};
}

/// Adds rays of a narrow cone, many of which reach the same boxes and triangles. Each has its own reach and
/// source.
void addPencil(const glm::vec3& origin, const glm::vec3& axis, float spread, std::uint32_t triangles,
               std::mt19937& random, std::vector<Ray>& rays) {
  std::uniform_real_distribution<float> reach(0.05f, 3.0f);
  for (std::size_t k = 0; k < raysOfPencil; ++k) {
    const float tMax = k % 3 == 0 ? reach(random) : std::numeric_limits<float>::infinity();
    const auto source = k % 4 == 0 ? static_cast<std::uint32_t>(random() % triangles) : PRELIGHT_NO_TRIANGLE;
    rays.push_back(rayFrom(origin, axis + spread * test::randomDirection(random), tMax, source));
  }
}

std::vector<Ray> pencilsThrough(std::uint32_t triangles, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<Ray> rays;
  for (int p = 0; p < 400; ++p)
    addPencil({unit(random), unit(random), unit(random)}, test::randomDirection(random),
              0.3f * unit(random) * unit(random), triangles, random, rays);
  return rays;
}

/// Expects the same hits from shuffled rays, which mostly share their group with no ray of the same origin.
std::size_t expectSameAlone(Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<std::size_t> order(rays.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(14));
  std::vector<Ray> shuffled;
  for (const std::size_t i : order) shuffled.push_back(rays[i]);
  std::size_t found = 0;
  for (const bool any : {false, true}) {
    const auto together = any ? tracer.traceAny(rays) : tracer.traceClosest(rays);
    const auto alone = any ? tracer.traceAny(shuffled) : tracer.traceClosest(shuffled);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(std::memcmp(&alone[i], &together[order[i]], sizeof(Hit)), 0)
          << (any ? "any hit" : "closest hit") << " of ray " << order[i];
      found += alone[i].triangle != PRELIGHT_NO_TRIANGLE;
    }
  }
  return found;
}

Tracer wideTracer(const CompiledScene& scene) { return Tracer(scene, test::sharedDevice(), BvhLayout::Wide); }

TEST(Bundles, NarrowPencils_HitWhatTheirRaysHitAlone) {
  for (const float size : {0.05f, 0.5f}) {
    const CompiledScene scene = test::randomSoup(3000, size, 31);
    Tracer tracer = wideTracer(scene);
    const auto rays = pencilsThrough(3000, 32);
    EXPECT_GT(expectSameAlone(tracer, rays), rays.size() / 10);
  }
}

TEST(Bundles, HolesOfAlphaMasks_AreHolesForEveryRay) {
  CompiledScene scene = test::randomSoup(1000, 0.5f, 33);
  scene.texCoords.resize(scene.positions.size());
  for (std::size_t v = 0; v < scene.texCoords.size(); ++v)
    scene.texCoords[v] = {v % 3 == 1 ? 1.0f : 0.0f, v % 3 == 2 ? 1.0f : 0.0f};
  scene.images = {{"half", 2, 1, {255, 255, 255, 0, 255, 255, 255, 255}}};
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].alphaCutoff = 0.5f;
  const auto rays = pencilsThrough(1000, 34);
  Tracer masked = wideTracer(scene);
  const std::size_t found = expectSameAlone(masked, rays);
  scene.materials[0].alphaCutoff = -1.0f;
  Tracer whole = wideTracer(scene);
  EXPECT_LT(found, expectSameAlone(whole, rays));
}

/// Seen at grazing angles, the floor's triangles are needles that begin behind the origin. Their distance is
/// then that of a plane.
TEST(Bundles, GrazingPencils_HitTheFloorWhereTheirRaysHitAlone) {
  const CompiledScene scene = test::sceneOf({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                                            {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}});
  std::mt19937 random(35);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<Ray> rays;
  for (int p = 0; p < 400; ++p) {
    const float angle = 6.2831853f * unit(random), height = 1e-3f * unit(random) + 1e-5f;
    const glm::vec3 origin(0.8f * unit(random) - 0.4f, 0.8f * unit(random) - 0.4f, height);
    for (std::size_t k = 0; k < raysOfPencil; ++k) {
      const float a = angle + 0.2f * unit(random);
      const glm::vec3 direction(std::cos(a), std::sin(a), -height / (0.05f + 0.5f * unit(random)));
      rays.push_back(
          rayFrom(origin, direction, std::numeric_limits<float>::infinity(), PRELIGHT_NO_TRIANGLE));
    }
  }
  Tracer tracer = wideTracer(scene);
  EXPECT_EQ(expectSameAlone(tracer, rays), 2 * rays.size());
}

TEST(Bundles, PortableKernels_HitTheSame) {
  DeviceOptions options;
  options.portableKernels = true;
  const Device portable = Device::open(options);
  const CompiledScene scene = test::randomSoup(2000, 0.3f, 36);
  Tracer quick = wideTracer(scene), plain(scene, portable, BvhLayout::Wide);
  const auto rays = pencilsThrough(2000, 37);
  for (const bool any : {false, true}) {
    const auto a = any ? quick.traceAny(rays) : quick.traceClosest(rays);
    const auto b = any ? plain.traceAny(rays) : plain.traceClosest(rays);
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Hit)), 0) << any;
  }
}

}  // namespace
}  // namespace prelight
