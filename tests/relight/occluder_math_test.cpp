// Powers and logarithms of host/techniques/vector_occluders/occluder_math_funcs.cl are within their stated
// errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "device/buffer.h"
#include "support/probe_program.h"

namespace prelight {
namespace {

/// Values of one function of the file at all arguments.
std::vector<float> valuesOf(const std::string& function, const std::vector<float>& arguments) {
  const std::string file = test::probeFile(
      "#include \"techniques/vector_occluders/occluder_math_funcs.cl\"\n"
      "__kernel void probe(__global const float* in, __global float* out, uint count) {\n"
      "  const uint i = get_global_id(0);\n"
      "  if (i < count) out[i] = " +
      function +
      "(in[i]);\n"
      "}\n");
  DeviceContext& device = test::sharedDevice().context();
  const Buffer<float> in(device, std::span<const float>(arguments)), out(device, arguments.size());
  launchOnce(device, file, {}, "probe", arguments.size(), in, out,
             static_cast<std::uint32_t>(arguments.size()));
  return out.read();
}

TEST(OccluderMath, PowerOfTwo_IsWithinTheStatedError) {
  std::vector<float> arguments;
  for (int i = -126 * 512; i <= 126 * 512; ++i) arguments.push_back(static_cast<float>(i) / 512.0f);
  const std::vector<float> values = valuesOf("exp2Of", arguments);
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    worst = std::max(worst, std::abs(values[i] / std::exp2(double(arguments[i])) - 1.0));
  EXPECT_LE(worst, 2e-7);
}

TEST(OccluderMath, PowerOfTwo_BeyondItsRange_IsCut) {
  const std::vector<float> values = valuesOf("exp2Of", {-127.0f, -1e30f, 127.0f, 1e30f});
  EXPECT_EQ(values, (std::vector<float>{std::exp2(-126.0f), std::exp2(-126.0f), std::exp2(126.0f),
                                        std::exp2(126.0f)}));
}

TEST(OccluderMath, Logarithm_IsWithinTheStatedError) {
  std::vector<float> arguments;
  for (int exponent = -30; exponent <= 30; exponent += 5)
    for (int i = 0; i < 1024; ++i)
      arguments.push_back(std::ldexp(1.0f + static_cast<float>(i) / 1024.0f, exponent));
  const std::vector<float> values = valuesOf("log2Of", arguments);
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double right = std::log2(double(arguments[i]));
    worst = std::max(worst, std::abs(values[i] - right) / std::max(1.0, std::abs(right)));
  }
  EXPECT_LE(worst, 1e-6);
}

}  // namespace
}  // namespace prelight
