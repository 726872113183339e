#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "device/pocl.h"
#include "device/thread_check.h"
#include "prelight/error.h"
#include "support/own_process.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

using test::inOwnProcess;
using ::testing::HasSubstr;
using ::testing::Optional;

class PoclCache : public ::testing::Test {
 protected:
  PoclCache() : folder_(fs::path(::testing::TempDir()) / ("pocl-cache-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PoclCache() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(PoclCache, FolderThatTakesFiles_IsUsableAndLeftAsItIs) {
  EXPECT_EQ(whyUnusableForPocl(folder_), std::nullopt);
  EXPECT_EQ(whyUnusableForPocl(folder_ / "to" / "be" / "made"), std::nullopt);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(PoclCache, FileInItsPlaceOrAboveIt_IsNamed) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT(whyUnusableForPocl(folder_ / "file"), Optional(HasSubstr("file is not a folder")));
  EXPECT_THAT(whyUnusableForPocl(folder_ / "file" / "below"), Optional(HasSubstr("file is not a folder")));
  fs::create_symlink("nowhere", folder_ / "dangling");
  EXPECT_THAT(whyUnusableForPocl(folder_ / "dangling" / "below"),
              Optional(HasSubstr("dangling is not a folder")));
}

TEST_F(PoclCache, PlaceThatTakesNoFiles_IsUnusable) {
  EXPECT_TRUE(whyUnusableForPocl("/proc/nope"));
  EXPECT_TRUE(whyUnusableForPocl(""));
  EXPECT_THAT(whyUnusableForPocl(folder_ / std::string(900, 'a')), Optional(HasSubstr("characters")));
}

TEST_F(PoclCache, FolderOfAnotherUser_IsUnusable) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root becomes another user";
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_EQ(inOwnProcess([&] {
              if (::setresuid(65534, 65534, 65534) != 0) return 2;
              return whyUnusableForPocl(folder_ / "new") ? 0 : 1;
            }),
            0);
}

/// Mounts a small file system in memory on `folder`. Returns 0 if it is unusable for `reason`, 1 if not, and
/// 2 if mounting failed, as it does without root's rights.
int unusableOn(const fs::path& folder, unsigned long flags, const char* options, const std::string& reason) {
  return inOwnProcess([&] {
    if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder.c_str(), "tmpfs", flags, options) != 0)
      return 2;
    const auto why = whyUnusableForPocl(folder / "kernels");
    return why && why->find(reason) != std::string::npos ? 0 : 1;
  });
}

TEST_F(PoclCache, FileSystemThatIsFullReadOnlyOrRunsNoCode_IsUnusable) {
  const int small = unusableOn(folder_, 0, "size=1M", "1.0 MiB of its file system are free");
  if (small == 2) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(small, 0);
  EXPECT_EQ(unusableOn(folder_, 0, "size=16k", "No space left"), 0);
  EXPECT_EQ(unusableOn(folder_, MS_RDONLY, "size=64M", "Read-only file system"), 0);
  EXPECT_EQ(unusableOn(folder_, MS_NOEXEC, "size=64M", "noexec"), 0);
  EXPECT_EQ(unusableOn(folder_, 0, "size=64M", ""), 1) << "this one will do";
}

TEST(PoclCacheFolder, ThatFillsUpLater_IsTold) {
  EXPECT_EQ(inOwnProcess([] {
              ::setenv("POCL_CACHE_DIR", "/tmp", 1);
              if (problemOfPoclCache()) return 1;
              const rlimit few{1000, 1000};
              ::signal(SIGXFSZ, SIG_IGN);
              ::setrlimit(RLIMIT_FSIZE, &few);
              const auto problem = problemOfPoclCache();
              return problem && *problem == "PoCL cannot keep kernels in /tmp: File too large" ? 0 : 2;
            }),
            0);
}

TEST(PoclCacheFolder, Environment_NamesIt) {
  const auto folderWith = [](const std::function<void()>& set) {
    return inOwnProcess([&] {
      for (const char* name : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "HOME", "POCL_KERNEL_CACHE"})
        ::unsetenv(name);
      set();
      const std::string folder = poclCacheFolder();
      const char* names[] = {"/tmp/pocl/kcache", "/home/me/.cache/pocl/kcache", "/x/pocl/kcache", "/y",
                             "/x/pocl/uncached"};
      for (int i = 0; i < 5; ++i)
        if (folder == names[i]) return i;
      return 99;
    });
  };
  EXPECT_EQ(folderWith([] {}), 0);
  EXPECT_EQ(folderWith([] { ::setenv("HOME", "/home/me", 1); }), 1);
  EXPECT_EQ(folderWith([] {
              ::setenv("HOME", "/home/me", 1);
              ::setenv("XDG_CACHE_HOME", "/x", 1);
            }),
            2);
  EXPECT_EQ(folderWith([] {
              ::setenv("XDG_CACHE_HOME", "/x", 1);
              ::setenv("POCL_CACHE_DIR", "/y", 1);
            }),
            3);
  EXPECT_EQ(folderWith([] {
              ::setenv("XDG_CACHE_HOME", "/x", 1);
              ::setenv("POCL_KERNEL_CACHE", "0", 1);
            }),
            4);
}

TEST(PoclMethod, OfVersion6_IsTheOneThatDoesNotCrash) {
  DeviceInfo info;
  info.isPocl = true;
  info.driverVersion = "6.0+debian";
  EXPECT_EQ(neededPoclMethod(info), "cbs");
  EXPECT_EQ(inOwnProcess([&] {
              ::unsetenv("POCL_WORK_GROUP_METHOD");
              configurePocl(info);
              if (std::string(::getenv("POCL_WORK_GROUP_METHOD")) != "cbs") return 1;
              ::setenv("POCL_WORK_GROUP_METHOD", "loopvec", 1);
              configurePocl(info);
              return std::string(::getenv("POCL_WORK_GROUP_METHOD")) == "loopvec" ? 0 : 2;
            }),
            0);
  for (const char* version : {"3.1+debian", "5.0", "7.0", "16.0"}) {
    info.driverVersion = version;
    EXPECT_EQ(neededPoclMethod(info), "") << version;
  }
  info.isPocl = false;
  info.driverVersion = "6.0";
  EXPECT_EQ(neededPoclMethod(info), "");
}

TEST(PoclKernels, AreCompiledForAllGroupSizesAtOnceUnlessTheUserChooses) {
  constexpr const char* variable = "POCL_WORK_GROUP_SPECIALIZATION";
  DeviceInfo info;
  EXPECT_EQ(inOwnProcess([&] {
              ::unsetenv(variable);
              configurePocl(info);
              if (::getenv(variable) != nullptr) return 1;
              info.isPocl = true;
              configurePocl(info);
              if (std::string(::getenv(variable)) != "0") return 2;
              ::setenv(variable, "1", 1);
              configurePocl(info);
              return std::string(::getenv(variable)) == "1" ? 0 : 3;
            }),
            0);
}

TEST(Threads, AsManyAsTheSystemGives_AreNoError) { EXPECT_NO_THROW(requireThreads(8)); }

TEST(Threads, ThatTheSystemDoesNotGive_AreOutOfMemoryWithACount) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root becomes a user of whom nothing else runs";
  EXPECT_EQ(inOwnProcess([] {
              const rlimit few{2, 2};
              if (::setrlimit(RLIMIT_NPROC, &few) != 0 || ::setresuid(61234, 61234, 61234) != 0) return 2;
              try {
                requireThreads(8);
              } catch (const Error& error) {
                const std::string text = error.what();
                return error.code() == ExitCode::OutOfMemory &&
                               text.find("1 of the 8 threads") != std::string::npos
                           ? 0
                           : 3;
              }
              return 1;
            }),
            0);
}

TEST(Threads, OfARuntime_AreBoundedByPoclsVariable) {
  EXPECT_EQ(inOwnProcess([] {
              ::setenv("POCL_MAX_PTHREAD_COUNT", "1", 1);
              return threadsOfRuntime() == 1 ? 0 : 1;
            }),
            0);
  EXPECT_EQ(inOwnProcess([] {
              ::setenv("POCL_MAX_PTHREAD_COUNT", "nonsense", 1);
              return threadsOfRuntime() >= 1 ? 0 : 1;
            }),
            0);
}

}  // namespace
}  // namespace prelight
