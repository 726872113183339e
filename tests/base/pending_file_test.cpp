#include "base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "base/files.h"
#include "base/state_log.h"
#include "prelight/error.h"
#include "support/file_limit.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PendingFiles : public ::testing::Test {
 protected:
  void write(const fs::path& path, const std::string& text) const {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
    writeFileAtomically(path, std::span(&bytes, 1));
  }
  static void add(OutputFiles& files, const fs::path& path, const std::string& text) {
    files.add(path, std::as_bytes(std::span(text)));
  }
  std::string read(const fs::path& path) const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename().string());
    return names;
  }
  std::string errorOf(const fs::path& path) const {
    try {
      write(path, "new");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
      return error.what();
    }
    return "";
  }
  static mode_t modeOf(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
  }

  test::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST_F(PendingFiles, Name_AsLongAsTheFileSystemTakes_IsWritten) {
  const fs::path longest = folder_ / std::string(255, 'n');
  write(longest, "text");
  EXPECT_EQ(read(longest), "text");
  EXPECT_EQ(names().size(), 1u);
}

TEST_F(PendingFiles, Name_TooLong_IsRefusedBeforeTheWork) {
  EXPECT_THROW(checkWritable(folder_ / std::string(256, 'n'), "-o"), Error);
  EXPECT_TRUE(names().empty());
}

TEST_F(PendingFiles, LinkToNothing_IsFollowed) {
  fs::create_symlink("target", folder_ / "link");
  write(folder_ / "link", "text");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read(folder_ / "target"), "text");
}

TEST_F(PendingFiles, LinkToItself_IsRefused) {
  fs::create_symlink("link", folder_ / "link");
  EXPECT_THAT(errorOf(folder_ / "link"), HasSubstr("symbolic links"));
}

TEST_F(PendingFiles, Permissions_OfTheReplacedFileAreKept) {
  write(folder_ / "file", "old");
  ASSERT_EQ(::chmod((folder_ / "file").c_str(), 0640), 0);
  write(folder_ / "file", "new");
  EXPECT_EQ(modeOf(folder_ / "file"), 0640u);
  EXPECT_EQ(read(folder_ / "file"), "new");
}

TEST_F(PendingFiles, Permissions_OfANewFileFollowTheMask) {
  const mode_t mask = ::umask(027);
  write(folder_ / "file", "text");
  ::umask(mask);
  EXPECT_EQ(modeOf(folder_ / "file"), 0640u);
}

TEST_F(PendingFiles, State_IsItsOwnersAlone) {
  const mode_t mask = ::umask(0);
  StateLog(folder_ / "a.state", "bake", {}).commit(0.0);
  ::umask(mask);
  EXPECT_EQ(modeOf(folder_ / "a.state"), 0600u);
}

TEST_F(PendingFiles, Pipe_IsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(errorOf(folder_ / "pipe"), HasSubstr("not a regular file"));
  EXPECT_THROW(refuseSpecialFile(folder_ / "pipe"), InputError);
  EXPECT_THROW(refuseSpecialFile("/dev/zero"), InputError);
  EXPECT_THROW((void)StateLog::open(folder_ / "pipe", "bake", {}), InputError);
  EXPECT_NO_THROW(refuseSpecialFile(folder_));
}

/// A file without a name needs no removal when the process is killed.
TEST_F(PendingFiles, OnTheirWay_HaveNoName) {
  PendingFile file(folder_ / "file");
  file.write(std::as_bytes(std::span("text", 4)));
  EXPECT_TRUE(names().empty());
  file.close();
  EXPECT_TRUE(names().empty());
  file.moveIn();
  EXPECT_EQ(names(), std::set<std::string>{"file"});
  EXPECT_EQ(read(folder_ / "file"), "text");
}

TEST_F(PendingFiles, Many_TakeFewDescriptors) {
  const auto open = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open();
  OutputFiles files;
  for (int i = 0; i < 40; ++i) add(files, folder_ / std::to_string(i), "text");
  EXPECT_LT(open() - before, 12);
  files.commit();
  EXPECT_EQ(names().size(), 40u);
}

/// Name of a temporary file that a child process chose before it ended.
std::string nameOfDeadProcess() {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string name = temporaryName(0);
    ::_exit(::write(ends[1], name.data(), name.size()) < 0 ? 1 : 0);
  }
  ::close(ends[1]);
  std::string name(200, '\0');
  const ssize_t count = ::read(ends[0], name.data(), name.size());
  name.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return name;
}

TEST_F(PendingFiles, OfKilledProcesses_AreRemovedAtTheNextStart) {
  const std::string dead = nameOfDeadProcess(), own = temporaryName(3);
  ASSERT_FALSE(dead.empty());
  const std::string elsewhere = ".prelight-00000000" + dead.substr(dead.find('-', 10));
  for (const std::string& name :
       {dead, own, elsewhere, std::string(".prelight-something"), std::string("file")})
    write(folder_ / name, "text");
  checkWritable(folder_ / "out", "-o");
  EXPECT_EQ(names(), (std::set<std::string>{own, elsewhere, ".prelight-something", "file"}));
}

TEST_F(PendingFiles, Group_OfWhichOneDoesNotFit_LeavesAllAsTheyWere) {
  write(folder_ / "first", "old first");
  write(folder_ / "second", "old second");
  const test::FileLimit limit(64);
  OutputFiles files;
  add(files, folder_ / "first", "new first");
  EXPECT_THROW(add(files, folder_ / "second", std::string(1000, 'x')), Error);
  EXPECT_EQ(read(folder_ / "first"), "old first");
  EXPECT_EQ(read(folder_ / "second"), "old second");
}

TEST_F(PendingFiles, Group_LeftAlone_LeavesNothing) {
  {
    OutputFiles files;
    add(files, folder_ / "first", "new first");
    add(files, folder_ / "second", "new second");
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(PendingFiles, Group_OfWhichOneCannotTakeItsPlace_IsTakenBack) {
  write(folder_ / "first", "old first");
  OutputFiles files;
  add(files, folder_ / "first", "new first");
  add(files, folder_ / "fresh", "new");
  add(files, folder_ / "third", "new third");
  fs::create_directory(folder_ / "third");
  EXPECT_THROW(files.commit(), Error);
  EXPECT_EQ(read(folder_ / "first"), "old first");
  EXPECT_FALSE(fs::exists(folder_ / "fresh"));
}

TEST_F(PendingFiles, Group_ThatFits_LeavesNoOlderFile) {
  write(folder_ / "first", "old first");
  OutputFiles files;
  add(files, folder_ / "first", "new first");
  add(files, folder_ / "second", "new second");
  files.commit();
  EXPECT_EQ(read(folder_ / "first"), "new first");
  EXPECT_EQ(names(), (std::set<std::string>{"first", "second"}));
}

}  // namespace
}  // namespace prelight
