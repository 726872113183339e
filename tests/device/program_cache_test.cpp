#include "device/program_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "device/context.h"
#include "support/devices.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

class ProgramCacheTest : public ::testing::Test {
 protected:
  ProgramCacheTest()
      : folder_(fs::path(::testing::TempDir()) / ("prelight-cache-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~ProgramCacheTest() override { fs::remove_all(folder_); }

  void overwrite(const std::string& key, const std::string& text) {
    std::ofstream(folder_ / key, std::ios::binary) << text;
  }
  std::string contents(const std::string& key) {
    std::ifstream in(folder_ / key, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
  const std::vector<unsigned char> binary_{0, 1, 2, '\n', 255, 7};
};

TEST(Sha256, KnownMessage_HasItsPublishedDigest) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_F(ProgramCacheTest, StoredEntry_ComesBack) {
  const ProgramCache cache(folder_);
  EXPECT_EQ(cache.load("key"), std::nullopt);
  cache.store("key", binary_);
  EXPECT_EQ(cache.load("key"), binary_);
  EXPECT_EQ(cache.load("other"), std::nullopt);
}

TEST_F(ProgramCacheTest, CorruptTruncatedOrForeignEntry_CountsAsAbsent) {
  const ProgramCache cache(folder_);
  cache.store("key", binary_);
  const std::string good = contents("key");
  std::string flipped = good;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  for (const std::string& bad : {flipped, good.substr(0, good.size() - 1), good + "x", std::string("garbage"),
                                 std::string(), good.substr(0, 5)}) {
    overwrite("key", bad);
    EXPECT_EQ(cache.load("key"), std::nullopt);
  }
  overwrite("elsewhere", good);
  EXPECT_EQ(cache.load("elsewhere"), std::nullopt) << "an entry of another key must not be trusted";
}

TEST_F(ProgramCacheTest, UnwritableFolder_IsIgnored) {
  const ProgramCache cache("/proc/prelight-cannot-write-here");
  EXPECT_NO_THROW(cache.store("key", binary_));
  EXPECT_EQ(cache.load("key"), std::nullopt);
}

// A device context of its own, so that programs are built anew and only the disk can know them.
TEST_F(ProgramCacheTest, DeviceWithCache_RebuildsFromACorruptEntry) {
  ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  DeviceOptions options;
  options.cacheKernels = true;
  const auto build = [&] {
    const Device device = Device::open(options);
    EXPECT_NO_THROW(device.context().program("core/layout_probe_kernels.cl", {}));
  };
  build();
  const fs::path kernels = folder_ / "prelight" / "kernels";
  ASSERT_TRUE(fs::exists(kernels));
  std::vector<fs::path> entries(fs::directory_iterator(kernels), {});
  ASSERT_EQ(entries.size(), 1u);
  const auto size = fs::file_size(entries[0]);
  build();
  std::ofstream(entries[0], std::ios::binary) << "PRELIGHT-KERNEL-1 nonsense";
  build();
  EXPECT_EQ(fs::file_size(entries[0]), size) << "the corrupt entry must have been replaced";
  ::unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace prelight
