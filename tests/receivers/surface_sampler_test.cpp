#include "receivers/surface_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"

namespace prelight {
namespace {

/// A right triangle with sides of 1 m along x and y whose largest coordinate is `far` plus a metre.
CompiledScene triangleAt(float far) {
  return test::sceneOf({{far, 0, 0}, {far + 1, 0, 0}, {far, 1, 0}}, {{0, 1, 2}});
}

/// Distance in metres from the nearest edge of that triangle at the weights of its corners 1 and 2.
double leastDistance(const glm::dvec2& b) { return std::min({b.x, b.y, (1.0 - b.x - b.y) / std::sqrt(2.0)}); }

TEST(SurfaceSampler, PlacesInside_StayWithinAThousandth) {
  const glm::dvec2 place(0.2, 0.3);
  EXPECT_LE(glm::distance(keptOffEdges(triangleAt(0.0f), 0, place), place), 1e-3);
}

// Float coordinates are rounded to half their last place, so that an edge and a place on it may be one last
// place apart. Places are moved by more than that, and by no more than a few last places.
TEST(SurfaceSampler, PlacesOnEdges_AreMovedOffByMoreThanRounding) {
  for (const float far : {4096.0f, 10000.0f, 50000.0f}) {
    const CompiledScene scene = triangleAt(far);
    const double lastPlace = double(std::nextafter(far + 1.0f, 1e9f)) - double(far + 1.0f);
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
      const double distance = leastDistance(keptOffEdges(scene, 0, corner));
      EXPECT_GE(distance, lastPlace) << far;
      EXPECT_LE(distance, 5.0 * lastPlace) << far;
    }
  }
}

/// Interleaves the bits of three numbers, starting with the highest bit of the first one.
std::uint64_t interleaved(const glm::uvec3& cell) {
  std::uint64_t code = 0;
  for (int bit = 15; bit >= 0; --bit)
    for (int axis = 0; axis < 3; ++axis) code = code << 1 | ((cell[axis] >> bit) & 1u);
  return code;
}

// The ground has more triangles than are sorted at once; its centroids lie within the square of half-edge 1.
TEST(SurfaceSampler, Triangles_ComeAlongAMortonCurveEachOnce) {
  const CompiledScene scene = test::ground(200, 1.0f);
  std::vector<std::uint32_t> order;
  SurfaceSampler(scene, 5, Side::Front)
      .pass(2.0 * scene.triangleCount(), 16, [&](const SurfaceSample& sample, const auto&) {
        if (order.empty() || order.back() != sample.triangle) order.push_back(sample.triangle);
      });
  ASSERT_EQ(order.size(), scene.triangleCount());
  const auto centroid = [&](std::uint32_t triangle) {
    const auto& t = scene.triangles[triangle];
    return scene.positions[t.x] / 3.0f + scene.positions[t.y] / 3.0f + scene.positions[t.z] / 3.0f;
  };
  glm::vec3 low(2.0f), high(-2.0f);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    low = glm::min(low, centroid(t));
    high = glm::max(high, centroid(t));
  }
  const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low);
  std::uint64_t before = 0;
  for (const std::uint32_t t : order) {
    const std::uint64_t code = interleaved(
        glm::uvec3((glm::dvec3(centroid(t)) - glm::dvec3(low)) / std::max(extent.x, extent.z) * 65535.0));
    ASSERT_GE(code, before) << t;
    before = code;
  }
}

// Disagreeing normals at the corners do not change which side is the front; a receiver's own normal is on its
// side.
TEST(Receiver, CornersThatDisagree_LeaveTheFrontWhereTheTrianglesIs) {
  for (int corner = 0; corner < 3; ++corner) {
    CompiledScene scene = triangleAt(0.0f);
    for (const float sign : {1.0f, -1.0f}) {
      for (int i = 0; i < 3; ++i)
        scene.normals[static_cast<std::size_t>(i)] =
            sign * (i == corner ? glm::vec3(0, 0, 1) : glm::vec3(0.8f, 0.5f, -std::sqrt(0.11f)));
      EXPECT_EQ(orientedNormal(scene, 0), glm::dvec3(0, 0, 1)) << corner;
      for (const Side side : {Side::Front, Side::Back}) {
        const device::Receiver receiver = receiverAt(scene, {0, 0.3f, 0.3f, 1.0f}, side);
        const float up = side == Side::Front ? 1.0f : -1.0f;
        EXPECT_EQ(receiver.geometricNormal[2], up);
        EXPECT_GE(up * receiver.normal[2], 0.0f);
      }
    }
  }
}

}  // namespace
}  // namespace prelight
