#include "device/program_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "device/context.h"
#include "support/devices.h"
#include "support/environment_variable.h"

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

TEST_F(ProgramCacheTest, Folder_IsItsOwnersAlone) {
  const mode_t mask = ::umask(0);
  ProgramCache(folder_ / "prelight" / "kernels").store("key", binary_);
  ::umask(mask);
  for (const fs::path& part : {folder_, folder_ / "prelight", folder_ / "prelight" / "kernels"})
    EXPECT_EQ(fs::status(part).permissions(), fs::perms::owner_all) << part;
  EXPECT_EQ(fs::status(folder_ / "prelight" / "kernels" / "key").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

// The cache holds native code, which others must not replace.
TEST_F(ProgramCacheTest, FolderOrEntryThatOthersMayWriteTo_IsNotUsed) {
  const fs::path folder = folder_ / "prelight" / "kernels";
  const ProgramCache cache(folder);
  cache.store("key", binary_);
  ASSERT_EQ(cache.load("key"), binary_);
  for (const fs::path& place : {folder, folder_ / "prelight", folder / "key"})
    for (const fs::perms others : {fs::perms::group_write, fs::perms::others_write}) {
      fs::permissions(place, others, fs::perm_options::add);
      EXPECT_EQ(cache.load("key"), std::nullopt) << place;
      EXPECT_EQ(refusalOfCache(folder).has_value(), place != folder / "key");
      fs::permissions(place, others, fs::perm_options::remove);
    }
  EXPECT_EQ(cache.load("key"), binary_);
}

TEST_F(ProgramCacheTest, FolderOrEntryOfAnotherUser_IsNotUsed) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const fs::path folder = folder_ / "prelight" / "kernels";
  const ProgramCache cache(folder);
  cache.store("key", binary_);
  for (const fs::path& place : {folder / "key", folder}) {
    ASSERT_EQ(::chown(place.c_str(), 12345, 12345), 0);
    EXPECT_EQ(cache.load("key"), std::nullopt) << place;
    ASSERT_EQ(::chown(place.c_str(), 0, 0), 0);
  }
  EXPECT_EQ(cache.load("key"), binary_);
}

TEST_F(ProgramCacheTest, Entry_ThatIsALinkOrAPipe_CountsAsAbsent) {
  const ProgramCache cache(folder_);
  cache.store("key", binary_);
  fs::rename(folder_ / "key", folder_ / "elsewhere");
  fs::create_symlink("elsewhere", folder_ / "key");
  EXPECT_EQ(cache.load("key"), std::nullopt);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(cache.load("pipe"), std::nullopt);
}

TEST_F(ProgramCacheTest, UnwritableFolder_IsIgnored) {
  const ProgramCache cache("/proc/prelight-cannot-write-here");
  EXPECT_NO_THROW(cache.store("key", binary_));
  EXPECT_EQ(cache.load("key"), std::nullopt);
}

// Uses a device context of its own, so that programs are built anew and can only come from disk.
TEST_F(ProgramCacheTest, DeviceWithCache_RebuildsFromACorruptEntry) {
  const test::EnvironmentVariable cacheHome("XDG_CACHE_HOME", folder_.c_str());
  DeviceOptions options;
  options.cacheKernels = true;
  const auto build = [&] {
    const Device device = Device::open(options);
    EXPECT_NO_THROW(device.context().build("core/layout_probe_kernels.cl", {}));
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
}

}  // namespace
}  // namespace prelight
