#include "receivers/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "device/buffer.h"
#include "support/probe_program.h"

namespace prelight {
namespace {

// A bijection: seeds that differ stay different.
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

}  // namespace
}  // namespace prelight
