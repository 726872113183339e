#include "receivers/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "device/buffer.h"
#include "support/probe_program.h"

namespace prelight {
namespace {

// The hash is a bijection: different seeds stay different.
TEST(Sampling, HashOfDifferentNumbers_Differs) {
  std::vector<std::uint32_t> hashes;
  for (std::uint32_t i = 0; i < 1u << 20; ++i) hashes.push_back(sampling::hashInteger(i * 0x9e3779b9u));
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

TEST(Sampling, HashOfTheDevice_IsTheHosts) {
  const std::string file = test::probeFile(
      "#include \"core/sampling_funcs.cl\"\n"
      "__kernel void probe(__global uint* out) {\n"
      "  out[get_global_id(0)] = hashInteger((uint)get_global_id(0) * 0x9e3779b9u);\n"
      "}\n");
  DeviceContext& device = test::sharedDevice().context();
  const Buffer<std::uint32_t> out(device, 1024);
  launchOnce(device, file, {}, "probe", 1024, out);
  const std::vector<std::uint32_t> hashes = out.read();
  for (std::uint32_t i = 0; i < 1024; ++i) EXPECT_EQ(hashes[i], sampling::hashInteger(i * 0x9e3779b9u)) << i;
}

// (0,2)-sequence: each box of 2^-a by 2^-(m - a) holds one of the first 2^m points, and scrambling keeps
// that.
TEST(Sampling, PointsOfTheDevice_FillElementaryBoxesOnceEach) {
  constexpr std::uint32_t bits = 12, count = 1u << bits;
  const std::string file = test::probeFile(
      "#include \"core/sampling_funcs.cl\"\n"
      "__kernel void probe(uint seed, __global uint* out) {\n"
      "  const uint2 point = sampleSobolBits((uint)get_global_id(0), seed);\n"
      "  out[2 * get_global_id(0)] = point.x;\n"
      "  out[2 * get_global_id(0) + 1] = point.y;\n"
      "}\n");
  DeviceContext& device = test::sharedDevice().context();
  const Buffer<std::uint32_t> out(device, 2 * count);
  for (const std::uint32_t seed : {0u, 1u, 0xdeadbeefu}) {
    launchOnce(device, file, {}, "probe", count, seed, out);
    const std::vector<std::uint32_t> points = out.read();
    for (std::uint32_t across = 0; across <= bits; ++across) {
      std::vector<int> held(count, 0);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t column = std::uint64_t{points[2 * i]} >> (32 - across);
        const std::uint64_t row = std::uint64_t{points[2 * i + 1]} >> (32 - (bits - across));
        ++held[column << (bits - across) | row];
      }
      EXPECT_EQ(std::count(held.begin(), held.end(), 1), count)
          << "seed " << seed << ", 2^" << across << " wide";
    }
  }
}

}  // namespace
}  // namespace prelight
