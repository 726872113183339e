#include "device/compiler_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "device/context.h"
#include "device/kernel.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/environment_variable.h"

namespace prelight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Kind = CompileAnswer::Kind;

const CompileJob job{"-cl-std=CL1.2", "__kernel void nothing(__global uint* x) { x[0] = 1u; }"};

bool always() { return true; }

/// Makes compilers that are started during its lifetime fail as FAULT_COMPILER of faulty_runtime.cpp says.
class FaultyCompiler {
 public:
  explicit FaultyCompiler(const char* fault) : fault_("FAULT_COMPILER", fault) {}

 private:
  test::EnvironmentVariable library_{"LD_PRELOAD", FAULTY_RUNTIME};
  test::EnvironmentVariable fault_;
};

std::vector<std::string> childrenOfThisThread() {
  std::ifstream list("/proc/thread-self/children");
  return {std::istream_iterator<std::string>(list), {}};
}

struct Told final : Progress {
  void compiling(const KernelCompilation& kernels) override {
    programs.emplace_back(kernels.program);
    finished += kernels.finished ? 1 : 0;
  }
  bool stopRequested() const override { return stops; }

  std::vector<std::string> programs;
  int finished = 0;
  bool stops = false;
};

/// A device with empty caches, and a kernel file of the test's own.
class ColdDevice : public ::testing::Test {
 protected:
  ColdDevice()
      : folder_(std::filesystem::path(::testing::TempDir()) / ("cold-" + std::to_string(::getpid()))),
        cacheHome_("XDG_CACHE_HOME", folder_.c_str()) {
    std::filesystem::remove_all(folder_);
  }
  ~ColdDevice() override { std::filesystem::remove_all(folder_); }

  Device open(Progress* progress = nullptr) {
    Device device = Device::open({.progress = progress});
    // A name of its own, so that PoCL's cache does not know it either.
    device.context().addFile("test/add.cl", "// " + nameOfThisCase() + R"(
__kernel void add(__global uint* sums, uint term) { sums[get_global_id(0)] += term; }
)");
    return device;
  }

  static std::uint32_t fiveByKernel(DeviceContext& device) {
    Buffer<std::uint32_t> sums(device, 1);
    sums.fill(2u);
    Kernel<Buffer<std::uint32_t>, std::uint32_t>(device, "test/add.cl", {}, "add").launch({1, 1}, sums, 3u);
    return sums.read()[0];
  }

 private:
  static std::string nameOfThisCase() {
    return std::to_string(::getpid()) + ::testing::UnitTest::GetInstance()->current_test_info()->name();
  }

  std::filesystem::path folder_;
  test::EnvironmentVariable cacheHome_;
};

TEST(CompilerProcess, Source_BecomesABinaryOrALog) {
  CompilerProcess compiler(test::sharedDevice().info());
  const CompileAnswer built = compiler.compile(job, always);
  EXPECT_EQ(built.kind, Kind::Built);
  EXPECT_GT(built.text.size(), 100u);
  const CompileAnswer refused = compiler.compile({job.options, "__kernel void broken( {"}, always);
  EXPECT_EQ(refused.kind, Kind::Refused);
  EXPECT_THAT(refused.text, HasSubstr("error"));
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
}

TEST(CompilerProcess, Crash_IsToldWithSignalAndLastWords_AndTheNextJobHasAnotherProcess) {
  CompilerProcess compiler(test::sharedDevice().info());
  {
    const FaultyCompiler faulty("crash");
    const CompileAnswer crashed = compiler.compile(job, always);
    EXPECT_EQ(crashed.kind, Kind::Died);
    EXPECT_THAT(crashed.text, AllOf(HasSubstr("signal 6"), HasSubstr("LLVM ERROR: made up by a test"),
                                    Not(HasSubstr("a warning"))));
  }
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
}

TEST(CompilerProcess, KillFromOutside_IsToldApartFromACrash) {
  const FaultyCompiler faulty("kill");
  CompilerProcess compiler(test::sharedDevice().info());
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Killed);
}

TEST(CompilerProcess, CompilerThatHangs_EndsWhereTheCallerGivesUp) {
  const FaultyCompiler faulty("hang");
  CompilerProcess compiler(test::sharedDevice().info());
  int asked = 0;
  EXPECT_EQ(compiler.compile(job, [&] { return ++asked < 5; }).kind, Kind::Stopped);
  EXPECT_EQ(asked, 5);
}

TEST(CompilerProcess, ProcessThatHadNothingToDo_IsStartedAnew) {
  CompilerProcess compiler(test::sharedDevice().info());
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
}

TEST(CompilerProcess, ProcessThatWasKilledBetweenTwoJobs_IsStartedAnew) {
  CompilerProcess compiler(test::sharedDevice().info());
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
  for (const std::string& child : childrenOfThisThread()) ::kill(std::stoi(child), SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Built);
}

TEST(CompilerProcess, DeviceThatTheCompilerDoesNotSee_IsLeftToTheCaller) {
  DeviceInfo other = test::sharedDevice().info();
  other.driverVersion += " of another day";
  CompilerProcess compiler(other);
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Unavailable);
  EXPECT_EQ(compiler.compile(job, always).kind, Kind::Unavailable);
}

TEST_F(ColdDevice, Program_IsToldWhenItIsCompiledAndNotWhenItIsKnown) {
  Told told;
  {
    const Device device = open(&told);
    EXPECT_EQ(fiveByKernel(device.context()), 5u);
    EXPECT_EQ(fiveByKernel(device.context()), 5u);
  }
  EXPECT_GE(told.programs.size(), 2u);
  EXPECT_EQ(told.programs.front(), "test/add.cl");
  EXPECT_EQ(told.finished, 1);
  const Device again = open(&told);
  EXPECT_EQ(fiveByKernel(again.context()), 5u);
  EXPECT_EQ(told.finished, 1) << "it is in the cache";
}

TEST_F(ColdDevice, CompilerThatCrashes_IsAnErrorThatNamesFileRuntimeAndRemedy) {
  const Device device = open();
  {
    const FaultyCompiler faulty("crash");
    try {
      device.context().build("test/add.cl", {});
      FAIL() << "built";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
      EXPECT_THAT(error.what(), StartsWith("test/add.cl: "));
      EXPECT_THAT(error.what(), HasSubstr(device.info().platform + " " + device.info().driverVersion));
      EXPECT_THAT(error.what(), HasSubstr("LLVM ERROR: made up by a test"));
      EXPECT_THAT(error.fix(), HasSubstr("DeviceOptions::selector"));
    }
  }
  EXPECT_EQ(fiveByKernel(device.context()), 5u) << "the device serves on";
}

TEST_F(ColdDevice, CompilerThatIsKilled_IsOutOfMemory) {
  const Device device = open();
  const FaultyCompiler faulty("kill");
  try {
    device.context().build("test/add.cl", {});
    FAIL() << "built";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
  }
}

TEST_F(ColdDevice, StopDuringACompilation_InterruptsWithinASecond) {
  Told told;
  told.stops = true;
  const Device device = open(&told);
  const FaultyCompiler faulty("hang");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(device.context().build("test/add.cl", {}), Interrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5))
      << "a busy machine may be late";
}

}  // namespace
}  // namespace prelight
