// kernels/core/offset_funcs.cl: origins of rays that leave a hit point.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/tracer.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/probe_program.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr const char* thinKernel = R"(
#include "core/offset_funcs.cl"
// inputs [item][16]: corners a, b, c; u, v; unit normal; 2 unused. directions, origins [item][3].
__kernel void offsetOrigins(__global const float* inputs, __global const float* directions, __global float* origins) {
  const size_t i = get_global_id(0);
  __global const float* in = inputs + 16 * i;
  const float3 a = vload3(0, in), b = vload3(1, in), c = vload3(2, in), n = vload3(0, in + 11);
  const float3 point = pointOnTriangle(a, b, c, in[9], in[10]);
  const float3 error = pointError(a, b, c, in[9], in[10]);
  vstore3(offsetOrigin(point, error, n, vload3(i, directions)), i, origins);
}
)";

struct Leaving {
  std::vector<glm::vec3> corners;  ///< [item][3].
  std::vector<glm::dvec3> normals;
  std::vector<float> inputs;
  std::vector<float> directions;
};

/// Hit points on triangles of `size`, `away` from zero: inside, on edges and at corners, left on both sides.
Leaving leavingPoints(std::size_t count, float size, float away) {
  test::Counter random(61);
  Leaving l;
  while (l.normals.size() < count) {
    const glm::vec3 place = away * random.direction();
    glm::vec3 p[3];
    for (auto& corner : p) corner = place + size * random.direction() * random.uniform();
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
    if (glm::length(normal) < 0.01 * size * size) continue;
    const float u = random.below(4) == 0 ? 0.0f : random.uniform();
    const float v = random.below(4) == 0 ? 1.0f - u : (1.0f - u) * random.uniform();
    const glm::vec3 direction = random.direction();
    l.corners.insert(l.corners.end(), p, p + 3);
    l.normals.push_back(glm::normalize(normal));
    const glm::vec3 n(l.normals.back());
    l.inputs.insert(l.inputs.end(), {p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z,
                                     u, v, n.x, n.y, n.z, 0, 0});
    l.directions.insert(l.directions.end(), {direction.x, direction.y, direction.z});
  }
  return l;
}

std::vector<float> offsetOrigins(const Leaving& l) {
  DeviceContext& device = test::sharedDevice().context();
  const Buffer<float> inputs(device, l.inputs), directions(device, l.directions),
      origins(device, l.directions.size());
  launchOnce(device, test::probeFile(thinKernel), {}, "offsetOrigins", {l.normals.size(), 1}, inputs,
             directions, origins);
  return origins.read();
}

// Every origin lies on the side to which its ray leaves, not much farther than the error bound, and the ray
// does not hit the triangle again.
TEST(OffsetOrigin, AnyScaleAndPlace_LiesOnTheSideOfTheRayAndNear) {
  for (const float size : {1e-6f, 1e-3f, 1.0f, 1e6f})
    for (const float ratio : {0.0f, 1.0f, 1e3f}) {
      const Leaving l = leavingPoints(4000, size, ratio * size);
      const auto origins = offsetOrigins(l);
      std::size_t wrongSide = 0, far = 0;
      for (std::size_t i = 0; i < l.normals.size(); ++i) {
        const glm::dvec3 o(origins[3 * i], origins[3 * i + 1], origins[3 * i + 2]);
        const glm::dvec3 d(l.directions[3 * i], l.directions[3 * i + 1], l.directions[3 * i + 2]);
        const double side = glm::dot(d, l.normals[i]) < 0.0 ? -1.0 : 1.0;
        const double height = side * glm::dot(o - glm::dvec3(l.corners[3 * i]), l.normals[i]);
        wrongSide += !(height >= 0.0);
        // The bound is the sum of |n| times each coordinate's error bound, its own rounding, and one more
        // float.
        far += height > 3.0 * 0x1p-20 * double(size) * (1.0 + ratio);
      }
      EXPECT_EQ(wrongSide, 0u) << size << ' ' << ratio;
      EXPECT_EQ(far, 0u) << size << ' ' << ratio;
    }
}

TEST(OffsetOrigin, LeavingRays_DoNotMeetTheirTriangle) {
  for (const float size : {1e-6f, 1.0f, 1e6f}) {
    const Leaving l = leavingPoints(3000, size, 100.0f * size);
    const auto origins = offsetOrigins(l);
    std::vector<glm::uvec3> triangles;
    std::vector<device::Ray> rays;
    for (std::uint32_t i = 0; i < l.normals.size(); ++i) {
      triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
      rays.push_back(test::makeRay({origins[3 * i], origins[3 * i + 1], origins[3 * i + 2]},
                                   {l.directions[3 * i], l.directions[3 * i + 1], l.directions[3 * i + 2]}));
    }
    Tracer tracer(test::sceneOf(l.corners, triangles), test::sharedDevice());
    const auto hits = tracer.traceClosest(rays);
    std::size_t own = 0;
    for (std::uint32_t i = 0; i < hits.size(); ++i) own += hits[i].triangle == i;
    EXPECT_EQ(own, 0u) << size;
  }
}

}  // namespace
}  // namespace prelight
