#include <gtest/gtest.h>

#include <random>

#include "base/directions.h"
#include "benchmarks/lab/lab_kernels.h"
#include "device/kernel.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr double statedError = 6.5e-5;

/// Random directions, the axes and their neighbours, and the edges of the folded square.
std::vector<glm::vec3> someDirections() {
  std::mt19937 random(5);
  std::vector<glm::vec3> directions;
  for (int i = 0; i < 100000; ++i) directions.push_back(test::randomDirection(random));
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f})
      for (const float slant : {0.0f, -0.0f, 1e-7f, -1e-7f, 1e-4f}) {
        glm::vec3 d(slant);
        d[axis] = side;
        directions.push_back(glm::normalize(d));
      }
  return directions;
}

struct Probed {
  std::vector<std::uint32_t> packed;
  std::vector<glm::vec4> unpacked;
};

Probed probe(const std::vector<glm::vec3>& directions) {
  DeviceContext& device = test::sharedDevice().context();
  std::vector<glm::vec4> padded;
  for (const glm::vec3& d : directions) padded.emplace_back(d, 0.0f);
  const Buffer<glm::vec4> in(device, std::span<const glm::vec4>(padded));
  const Buffer<std::uint32_t> packed(device, directions.size());
  const Buffer<glm::vec4> unpacked(device, directions.size());
  launchOnce(device, labKernel(device, "direction_probe_kernels.cl"), {}, "probeDirections",
             directions.size(), static_cast<std::uint32_t>(directions.size()), in, packed, unpacked);
  return {packed.read(), unpacked.read()};
}

TEST(PackedDirection, AnyDirection_ComesBackWithinTheStatedError) {
  const std::vector<glm::vec3> directions = someDirections();
  const Probed onDevice = probe(directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const glm::dvec3 d = directions[i];
    ASSERT_LT(glm::length(unpackDirection(packDirection(d)) - d), statedError) << i;
    ASSERT_LT(glm::length(glm::dvec3(onDevice.unpacked[i]) - d), statedError) << i;
    ASSERT_NEAR(glm::length(glm::vec3(onDevice.unpacked[i])), 1.0f, 1e-6f) << i;
  }
}

TEST(PackedDirection, HostAndDevice_ReadEachOther) {
  const std::vector<glm::vec3> directions = someDirections();
  const Probed onDevice = probe(directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    ASSERT_LT(glm::length(unpackDirection(onDevice.packed[i]) - glm::dvec3(directions[i])), statedError) << i;
    ASSERT_LT(glm::length(unpackDirection(onDevice.packed[i]) - glm::dvec3(onDevice.unpacked[i])), 1e-6) << i;
  }
}

TEST(PackedDirection, NoDirection_IsUp) {
  EXPECT_LT(glm::length(unpackDirection(packDirection(glm::dvec3(0.0))) - glm::dvec3(0, 0, 1)), statedError);
  EXPECT_LT(glm::length(glm::dvec3(probe({glm::vec3(0.0f)}).unpacked[0]) - glm::dvec3(0, 0, 1)), statedError);
}

}  // namespace
}  // namespace prelight
