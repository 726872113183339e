#include "base/state_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "base/resumable_run.h"
#include "prelight/error.h"
#include "support/file_limit.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Numbers = std::vector<std::uint32_t>;

void write(StateLog& log, const std::string& name, const Numbers& numbers) {
  log.write(name, [&](const StateWriter::Sink& sink) { sink(std::as_bytes(std::span(numbers))); });
}

Numbers read(const StateLog& log, const std::string& name) {
  const std::vector<std::byte> bytes = log.read(name);
  Numbers numbers(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// Writes an array and counts in `asked` how many elements the log asks for.
void writeArray(StateLog& log, const std::string& name, const Numbers& numbers, std::uint64_t epoch = 0,
                std::uint64_t* asked = nullptr) {
  log.writeArray(name, epoch, numbers.size(), sizeof(std::uint32_t),
                 [&](std::uint64_t first, std::uint64_t count) {
                   if (asked != nullptr) *asked += count;
                   return std::as_bytes(std::span(numbers).subspan(first, count));
                 });
}

Numbers readArray(const StateLog& log, const std::string& name, std::size_t count) {
  Numbers numbers(count);
  EXPECT_TRUE(log.readArray(name, count, sizeof(std::uint32_t),
                            [&](std::uint64_t first, std::span<const std::byte> elements) {
                              std::memcpy(&numbers[first], elements.data(), elements.size());
                            }));
  return numbers;
}

class StateLogFile : public ::testing::Test {
 protected:
  StateLog fresh() const { return {path_, "bake", key_}; }
  StateLog reopened() const { return std::move(*StateLog::open(path_, "bake", key_)); }

  /// Makes two commits: numbers and an array, then other numbers and another array.
  void writeTwice() const {
    StateLog log = fresh();
    write(log, "first", {1, 2, 3});
    writeArray(log, "grown", {10, 11});
    log.commit(5.0);
    write(log, "first", {4, 5});
    write(log, "second", {6});
    writeArray(log, "grown", {10, 11, 12});
    log.commit(7.5);
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  std::string inputError() const {
    try {
      (void)StateLog::open(path_, "bake", key_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder temporary_;
  fs::path path_ = temporary_ / "out.glb.state";
  StateKey key_ = {{"scene", 1}, {"options", 2}, {"seed", 3}};
};

TEST_F(StateLogFile, WhatWasCommitted_ComesBack) {
  writeTwice();
  const StateLog log = reopened();
  EXPECT_EQ(read(log, "first"), (Numbers{4, 5}));
  EXPECT_EQ(read(log, "second"), (Numbers{6}));
  EXPECT_EQ(readArray(log, "grown", 3), (Numbers{10, 11, 12}));
  EXPECT_EQ(log.seconds(), 7.5);
}

TEST_F(StateLogFile, WithoutCommit_ThereIsNoFile) {
  StateLog log = fresh();
  write(log, "first", {1});
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_FALSE(StateLog::open(path_, "bake", key_));
}

TEST_F(StateLogFile, WithoutASecondCommit_TheFirstCounts) {
  {
    StateLog log = fresh();
    write(log, "first", {1});
    log.commit(1.0);
    write(log, "first", {2});
    write(log, "second", {3});
  }
  const StateLog log = reopened();
  EXPECT_EQ(read(log, "first"), (Numbers{1}));
  EXPECT_FALSE(log.has("second"));
}

TEST_F(StateLogFile, GoneOnWith_KeepsWhatWasThere) {
  writeTwice();
  {
    StateLog log = reopened();
    writeArray(log, "grown", {10, 11, 12, 13});
    log.erase("sec");
    log.commit(9.0);
  }
  const StateLog log = reopened();
  EXPECT_THAT(log.names(), ElementsAre("first"));
  EXPECT_EQ(readArray(log, "grown", 4), (Numbers{10, 11, 12, 13}));
}

TEST_F(StateLogFile, Array_IsWrittenOnce_UnlessItsEpochChanges) {
  {
    StateLog log = fresh();
    std::uint64_t asked = 0;
    writeArray(log, "grown", {1, 2, 3}, 0, &asked);
    writeArray(log, "grown", {1, 2, 3, 4}, 0, &asked);
    EXPECT_EQ(asked, 4u);
    writeArray(log, "grown", {7, 8}, 1, &asked);
    EXPECT_EQ(asked, 6u);
    log.commit(0.0);
  }
  const StateLog log = reopened();
  EXPECT_EQ(readArray(log, "grown", 2), (Numbers{7, 8}));
  EXPECT_FALSE(log.readArray("grown", 3, sizeof(std::uint32_t), {})) << "there are not so many";
}

TEST_F(StateLogFile, RolledBack_IsAsAfterTheLastCommit) {
  StateLog log = fresh();
  write(log, "first", {1});
  log.commit(0.0);
  const std::string before = bytes();
  write(log, "first", {2});
  log.rollBack();
  EXPECT_EQ(bytes(), before);
  EXPECT_EQ(read(log, "first"), (Numbers{1}));
}

/// A full disk leaves the last state that fitted.
TEST_F(StateLogFile, DiskThatIsFull_LeavesTheLastState) {
  std::optional<StateLog> log(fresh());
  write(*log, "first", {1});
  log->commit(0.0);
  {
    const test::FileLimit limit(4096);
    EXPECT_THROW(write(*log, "first", Numbers(5000, 7)), Error);
    log->rollBack();
  }
  EXPECT_EQ(read(*log, "first"), (Numbers{1}));
  write(*log, "first", Numbers(5000, 7));
  log->commit(0.0);
  log.reset();
  EXPECT_EQ(read(reopened(), "first"), Numbers(5000, 7));
}

/// A power cut may lose the end of the file, but not what an earlier commit wrote.
TEST_F(StateLogFile, EveryCut_IsRefused_OrLeavesAnEarlierCommit) {
  writeTwice();
  const std::string whole = bytes();
  int earlier = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    replace(whole.substr(0, size));
    try {
      const StateLog log = reopened();
      EXPECT_EQ(read(log, "first"), (Numbers{1, 2, 3})) << "cut to " << size;
      ++earlier;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(earlier, 10);
}

TEST_F(StateLogFile, EveryFlippedByte_IsRefused_OrLeavesACommit) {
  writeTwice();
  const std::string whole = bytes();
  std::size_t refused = 0, earlier = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    replace(damaged);
    try {
      const Numbers first = read(reopened(), "first");
      EXPECT_TRUE(first == (Numbers{4, 5}) || first == (Numbers{1, 2, 3})) << "byte " << i;
      earlier += first == (Numbers{1, 2, 3}) ? 1 : 0;
    } catch (const Error&) {
      ++refused;
    }
  }
  // The commits, which are checked separately.
  constexpr std::size_t commits = 2 * 5 * sizeof(std::uint64_t);
  EXPECT_GE(refused + earlier, whole.size() - commits);
  EXPECT_GT(earlier, 10u);
  replace(whole + "what a killed process was writing");
  EXPECT_EQ(read(reopened(), "first"), (Numbers{4, 5}));
}

TEST_F(StateLogFile, AnotherRuns_IsBadUsageThatNamesTheDifference) {
  writeTwice();
  try {
    (void)StateLog::open(path_, "bake", {{"scene", 1}, {"options", 9}, {"seed", 4}});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another options, seed"));
  }
}

TEST_F(StateLogFile, AnotherKind_IsRefused) {
  writeTwice();
  EXPECT_THROW((void)StateLog::open(path_, "reference", key_), InputError);
  replace("something else entirely");
  EXPECT_THAT(inputError(), HasSubstr("not a state"));
}

TEST_F(StateLogFile, HeldByAnother_IsRefused) {
  StateLog log = fresh();
  log.commit(0.0);
  EXPECT_THROW((void)StateLog::open(path_, "bake", key_), UsageError);
}

TEST_F(StateLogFile, HeldByAnother_IsNotReplacedByANewOne) {
  writeTwice();
  const StateLog holder = reopened();
  StateLog second = fresh();
  write(second, "first", {9});
  try {
    second.commit(1.0);
    FAIL() << "the other run's file was replaced";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    EXPECT_THAT(error.what(), HasSubstr("another run"));
  }
  EXPECT_EQ(read(*StateLog::open(path_, "bake", key_, StateLog::Access::Read), "first"), (Numbers{4, 5}));
}

TEST_F(StateLogFile, HeldByAnother_IsNotRemovedByARunThatIsDone) {
  writeTwice();
  Progress progress;
  ResumableRun run(path_, "bake");
  (void)run.begin(key_, progress, StateUse::Replace);
  {
    const StateLog holder = reopened();
    run.remove();
    EXPECT_TRUE(fs::exists(path_));
  }
  run.remove();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(StateLogFile, HeldByAnother_IsNotReplacedByARunThatBegins) {
  writeTwice();
  Progress progress;
  ResumableRun run(path_, "bake");
  {
    const StateLog holder = reopened();
    EXPECT_THROW((void)run.begin(key_, progress, StateUse::Replace), UsageError);
  }
  EXPECT_NO_THROW((void)run.begin(key_, progress, StateUse::Replace));
}

/// A run that ends without unlocking leaves no lock: the system ends it with the process.
TEST_F(StateLogFile, HeldByAKilledProcess_IsFree) {
  writeTwice();
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    const StateLog holder = reopened();
    if (::write(ready[1], "x", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char told = 0;
  ASSERT_EQ(::read(ready[0], &told, 1), 1);
  EXPECT_THROW((void)reopened(), UsageError);
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_EQ(read(reopened(), "first"), (Numbers{4, 5}));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(StateLogFile, WhatWasReplaced_DoesNotFillTheDisk) {
  {
    StateLog log = fresh();
    writeArray(log, "grown", {1, 2, 3});
    const Numbers megabyte(1u << 18);
    for (std::uint32_t i = 0; i < 200; ++i) {
      write(log, "first", megabyte);
      log.commit(0.0);
    }
    EXPECT_LT(fs::file_size(path_), std::uintmax_t{70} << 20);
    write(log, "last", {5});
    log.commit(0.0);
  }
  const StateLog log = reopened();
  EXPECT_EQ(readArray(log, "grown", 3), (Numbers{1, 2, 3}));
  EXPECT_EQ(read(log, "last"), (Numbers{5}));
}

TEST_F(StateLogFile, Deleted_IsThereAgainWithTheNextCommit) {
  {
    StateLog log = fresh();
    write(log, "first", {1});
    log.commit(0.0);
    fs::remove(path_);
    write(log, "second", {2});
    log.commit(0.0);
  }
  EXPECT_EQ(read(reopened(), "first"), (Numbers{1}));
}

TEST(StateHash, DependsOnEveryByteAndOnBoundaries) {
  const auto hash = [](const std::vector<std::uint32_t>& v) { return StateHash().values(v).result(); };
  EXPECT_EQ(hash({1, 2, 3}), hash({1, 2, 3}));
  EXPECT_NE(hash({1, 2, 3}), hash({1, 2, 4}));
  EXPECT_NE(hash({1, 2, 3}), hash({1, 2, 0x80000003u}));
  EXPECT_NE(hash({1, 0}), hash({1}));
  EXPECT_NE(StateHash().text("ab").text("c").result(), StateHash().text("a").text("bc").result());
}

}  // namespace
}  // namespace prelight
