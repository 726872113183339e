// Distances to the planes of needles, a fallback of kernels/bvh/block_funcs.cl.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "bvh/layouts.h"
#include "device/buffer.h"
#include "gpu/tracer.h"
#include "support/probe_program.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Ray;
using device::TriangleBlock;

constexpr std::size_t lanes = PRELIGHT_WIDTH;

constexpr const char* text = R"(
#include "bvh/block_funcs.cl"
__kernel void probe(__global const TriangleBlock* blocks, __global const Ray* rays, uint count, __global float* out) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  RayGroup group;
  prepareGroup(rays + i, 1u, &group);
  vstore8(planeDistances(blocks + i, &group, 0u), i, out);
}
)";

glm::dvec3 cornerOf(const TriangleBlock& block, int corner, std::size_t lane) {
  return {block.vertex[corner][0][lane], block.vertex[corner][1][lane], block.vertex[corner][2][lane]};
}

TEST(PlaneDistance, AnyTriangleAndRay_AgreesWithDoublePrecision) {
  constexpr std::size_t count = 300;
  std::mt19937 random(41);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  std::vector<TriangleBlock> blocks(count);
  std::vector<Ray> rays;
  for (TriangleBlock& block : blocks) {
    for (auto& corner : block.vertex)
      for (auto& axis : corner)
        for (float& value : axis) value = unit(random);
    const glm::vec3 d = 3.0f * test::randomDirection(random);
    rays.push_back(
        {{unit(random), unit(random), unit(random)}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, 1e30f});
  }
  DeviceContext& device = test::sharedDevice().context();
  const Buffer<TriangleBlock> triangles(device, std::span<const TriangleBlock>(blocks));
  const Buffer<Ray> from(device, std::span<const Ray>(rays));
  const Buffer<float> out(device, lanes * count);
  launchOnce(device, test::probeFile(text), {}, "probe", count, triangles, from,
             static_cast<std::uint32_t>(count), out);
  const std::vector<float> distances = out.read();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 o(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]),
        d(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const glm::dvec3 a = cornerOf(blocks[i], 0, lane), b = cornerOf(blocks[i], 1, lane) - a,
                       c = cornerOf(blocks[i], 2, lane) - a, n = glm::cross(b, c);
      // Residual of the plane's equation at the distance, relative to the size of its terms.
      const double t = distances[lanes * i + lane];
      const double terms =
          glm::length(b) * glm::length(c) * (glm::length(a - o) + std::abs(t) * glm::length(d));
      EXPECT_LE(std::abs(glm::dot(n, o + t * d - a)), 2e-6 * terms) << "ray " << i << ", lane " << lane;
    }
  }
}

}  // namespace
}  // namespace prelight
