#include "prelight/device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>
#include <vector>

#include "device/buffer.h"
#include "device/context.h"
#include "gpu/self_test.h"
#include "prelight/error.h"
#include "support/devices.h"

namespace prelight {
namespace {

Device openBy(const std::string& selector) {
  DeviceOptions options;
  options.selector = selector;
  return Device::open(options);
}

TEST(Device, Selector_FindsByIndexKindAndName) {
  const auto devices = listDevices();
  ASSERT_FALSE(devices.empty());
  EXPECT_EQ(openBy("0").info().name, devices[0].name);
  EXPECT_EQ(openBy(devices[0].name.substr(2, 6)).info().platform, devices[0].platform);
  if (devices[0].kind == DeviceKind::Cpu) {
    EXPECT_EQ(openBy("CPU").info().index, 0);
  }
}

TEST(Device, UnknownSelector_IsAnErrorThatListsWhatThereIs) {
  for (const std::string selector : {"no such device", "99", "-1"}) {
    try {
      openBy(selector);
      FAIL() << selector;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::NoDevice);
      EXPECT_NE(std::string(error.what()).find(listDevices()[0].name), std::string::npos) << error.what();
    }
  }
}

TEST(Device, OpenedByManyThreadsAtOnce_WorksInEach) {
  // The test is meaningful only as the first of its process, because loaders initialise once.
  std::atomic<int> opened = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
      threads.emplace_back([&] {
        const Device device = Device::open({});
        opened += device.info().name.empty() ? 0 : 1;
      });
  }
  EXPECT_EQ(opened, 8);
}

TEST(Device, SelfTest_PassesOnEveryDevice) {
  for (const auto& info : listDevices())
    for (const auto& result : selfTest(openBy(std::to_string(info.index))))
      EXPECT_TRUE(result.passed) << info.name << ": " << result.name << ": " << result.detail;
}

TEST(DeviceContext, ProgramThatDoesNotBuild_ReportsDeviceOptionsAndLog) {
  DeviceContext& device = test::sharedDevice().context();
  try {
    // The traversal needs a stack: a negative size cannot compile.
    device.build("bvh/wide_kernels.cl", BuildOptions().define("PRELIGHT_STACK_SIZE", -100));
    FAIL() << "built";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(device.info().name), std::string::npos) << text;
    EXPECT_NE(text.find("PRELIGHT_STACK_SIZE=-100"), std::string::npos) << text;
    EXPECT_NE(text.find("walk_funcs.cl"), std::string::npos) << "the log must name the real file: " << text;
  }
}

TEST(DeviceContext, BufferBeyondTheDevice_IsOutOfMemory) {
  DeviceContext& device = test::sharedDevice().context();
  try {
    Buffer<char>(device, device.info().maxAllocation + 1);
    FAIL() << "allocated";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
  }
}

TEST(DeviceContext, DumpKernels_WritesTheExpandedSource) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "prelight-dump";
  std::filesystem::remove_all(folder);
  DeviceOptions options;
  options.dumpKernels = folder;
  const Device device = Device::open(options);
  device.context().build("core/layout_probe_kernels.cl", {});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(Buffer, Mapped_HoldsWhatWasWrittenInPlace) {
  Buffer<int> buffer(test::sharedDevice().context(), 8);
  {
    const auto room = buffer.overwritten(8);
    for (int i = 0; i < 8; ++i) room[static_cast<std::size_t>(i)] = i * i;
  }
  EXPECT_EQ(buffer.read(), (std::vector<int>{0, 1, 4, 9, 16, 25, 36, 49}));
  const auto held = buffer.mapped(3);
  EXPECT_EQ(held[2], 4);
}

TEST(Buffer, WrittenRange_ReadsBack) {
  Buffer<int> buffer(test::sharedDevice().context(), 8);
  buffer.fill(7);
  const std::vector<int> part{1, 2, 3};
  buffer.write(part, 2);
  EXPECT_EQ(buffer.read(), (std::vector<int>{7, 7, 1, 2, 3, 7, 7, 7}));
  EXPECT_TRUE(Buffer<int>(test::sharedDevice().context(), 0).read().empty());
}

}  // namespace
}  // namespace prelight
