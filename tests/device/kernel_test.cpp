#include "device/kernel.h"

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <glm/glm.hpp>

#include "device/buffer.h"
#include "prelight/error.h"
#include "shared/scene_layout_types.h"
#include "support/probe_program.h"

namespace prelight {
namespace {

using device::SurfaceLine;

constexpr const char* text =
    "__kernel void scale(const uint count, const float factor, __global const float* in, __global float* "
    "out) {\n"
    "  const size_t i = get_global_id(0);\n"
    "  if (i < count) out[i] = factor * in[i];\n"
    "}\n";

using Scale = Kernel<std::uint32_t, float, Buffer<float>, Buffer<float>>;

template <typename K, typename... Arguments>
concept Launches = requires(K& kernel, const Arguments&... arguments) {
  kernel.launch(1, arguments...);
};

static_assert(Launches<Scale, std::uint32_t, float, Buffer<float>, Buffer<float>>);
static_assert(!Launches<Scale, int, float, Buffer<float>, Buffer<float>>, "a value of another type");
static_assert(!Launches<Scale, std::uint32_t, double, Buffer<float>, Buffer<float>>,
              "a value of another size");
static_assert(!Launches<Scale, std::uint32_t, float, Buffer<std::uint32_t>, Buffer<float>>,
              "a buffer of others");
static_assert(!Launches<Scale, float, std::uint32_t, Buffer<float>, Buffer<float>>, "another order");
static_assert(!Launches<Scale, std::uint32_t, float, Buffer<float>>, "one too few");

DeviceContext& context() { return test::sharedDevice().context(); }

TEST(Kernel, TypedArguments_ReachTheDevice) {
  const std::vector<float> values = {1.0f, -2.0f, 0.5f};
  const Buffer<float> in(context(), std::span<const float>(values)), out(context(), 3);
  Scale kernel(context(), test::probeFile(text), {}, "scale");
  kernel.launch(3, std::uint32_t{3}, 4.0f, in, out);
  EXPECT_THAT(out.read(), testing::ElementsAre(4.0f, -8.0f, 2.0f));
}

// Each launch needs the result of the previous launch in its lane.
TEST(Kernel, CommandsOfALane_KeepTheirOrder) {
  Scale kernel(context(), test::probeFile(text), {}, "scale");
  constexpr std::size_t size = 1 << 16;
  const std::vector<float> ones(size, 1.0f);
  std::vector<std::array<Buffer<float>, 2>> turns;
  for (std::size_t lane = 0; lane < DeviceLane::count; ++lane) {
    turns.push_back(
        {Buffer<float>(context(), size, DeviceLane{lane}), Buffer<float>(context(), size, DeviceLane{lane})});
    turns.back()[0].write(std::span<const float>(ones));
  }
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t lane = 0; lane < turns.size(); ++lane)
      kernel.launch({size, DeviceLane{lane}}, static_cast<std::uint32_t>(size), lane == 0 ? 2.0f : 0.5f,
                    turns[lane][i % 2], turns[lane][(i + 1) % 2]);
  EXPECT_EQ(turns[0][0].read(), std::vector<float>(size, 0x1p24f));
  EXPECT_EQ(turns[1][0].read(), std::vector<float>(size, 0x1p-24f));
}

/// Expects that making a kernel of these types fails with an error that contains `said`.
template <typename K>
void expectRefused(const std::string& said) {
  try {
    const K kernel(context(), test::probeFile(text), {}, "scale");
    FAIL() << "made, where \"" << said << "\" was expected";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    EXPECT_THAT(error.what(), testing::HasSubstr("kernel scale"));
    EXPECT_THAT(error.what(), testing::HasSubstr(said));
  }
}

TEST(Kernel, ParametersOtherThanTheBuiltOnes_AreRefused) {
  expectRefused<Kernel<std::uint32_t, float, Buffer<float>>>("takes 4 arguments, got 3");
  expectRefused<Kernel<std::uint32_t, float, Buffer<float>, Buffer<float>, float>>(
      "takes 4 arguments, got 5");
}

/// The check needs a device that reports its kernels' parameters.
TEST(Kernel, KindsOtherThanTheBuiltOnes_AreRefused) {
  if (!context().info().isPocl) GTEST_SKIP() << "only PoCL is known to tell";
  expectRefused<Kernel<std::uint32_t, float, Buffer<float>, float>>(
      "parameter 3 expects a buffer, got a value");
  expectRefused<Kernel<Buffer<float>, float, Buffer<float>, Buffer<float>>>("parameter 0 expects a value");
  expectRefused<Kernel<std::uint32_t, double, Buffer<float>, Buffer<float>>>(
      "parameter 1 expects a float of 4 bytes, got 8 bytes");
}

/// Arrays of any type, empty ones too, begin at a line and keep their bytes.
TEST(PackedArrays, ArraysOfSeveralTypes_BeginWithLinesAndKeepTheirBytes) {
  const std::vector<std::uint8_t> bytes(65, 7);
  const std::vector<glm::vec2> pairs = {{1.0f, 2.0f}, {3.0f, 4.0f}};
  PackedArrays<SurfaceLine> pack;
  EXPECT_EQ(pack.add(std::span<const std::uint8_t>(bytes)), 0u);
  EXPECT_EQ(pack.add(std::vector<float>()), 2u);
  EXPECT_EQ(pack.reserve<float>(17), 2u);
  EXPECT_EQ(pack.add(std::vector<glm::vec2>(pairs)), 4u);
  EXPECT_EQ(pack.lines(), 5u);
  Buffer<SurfaceLine> buffer = pack.upload(context());
  const std::vector<float> late = {9.0f};
  buffer.writeArray(std::span<const float>(late), 2);
  const std::vector<SurfaceLine> lines = buffer.read();
  EXPECT_EQ(lines[0].words[15], 0x07070707u);
  EXPECT_EQ(lines[1].words[0] & 0xffu, 7u);
  EXPECT_EQ(std::bit_cast<float>(lines[2].words[0]), 9.0f);
  EXPECT_EQ(std::bit_cast<float>(lines[4].words[1]), 2.0f);
  EXPECT_EQ(std::bit_cast<float>(lines[4].words[2]), 3.0f);
}

}  // namespace
}  // namespace prelight
