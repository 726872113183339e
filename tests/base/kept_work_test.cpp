#include "base/kept_work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "base/resumable_run.h"
#include "prelight/error.h"
#include "support/file_limit.h"
#include "support/gltf_files.h"
#include "support/resumed.h"

namespace prelight {
namespace {

/// Work that sums rows of numbers in nested parts and counts the additions.
class Sums {
 public:
  std::vector<int> run(const Progress& progress) {
    std::vector<int> sums;
    WorkPart part(progress, "rows", [&](auto& state) { state.growing(sums); });
    while (sums.size() < 5) {
      const int first = row(progress, 10 * static_cast<int>(sums.size()));
      const int second = row(progress, 1000);
      sums.push_back(first + second);
      part.advance();
    }
    part.finish();
    return sums;
  }

  int added = 0;

 private:
  int row(const Progress& progress, int from) {
    int sum = 0, next = 0;
    WorkPart part(progress, "row", [&](auto& state) {
      state.value(sum);
      state.value(next);
    });
    for (; next < 4; ++next, part.advance()) {
      progress.check();
      sum += from + next;
      ++added;
    }
    part.finish();
    return sum;
  }
};

const std::vector<int> wholeSums = {4012, 4052, 4092, 4132, 4172};

TEST(KeptWork, WithoutAKeeper_IsDone) {
  Sums sums;
  EXPECT_EQ(sums.run(Progress()), wholeSums);
  EXPECT_EQ(sums.added, 40);
}

TEST(KeptWork, StoppedAnywhere_GoesOnWhereItWas) {
  for (int looks = 1; looks <= 40; ++looks) {
    const test::TemporaryFolder folder;
    Sums sums;
    {
      ResumableRun run(folder / "a.state", "sums");
      test::StopAfterLooks stops(looks);
      Progress& progress = run.begin({}, stops, StateUse::Continue);
      try {
        EXPECT_EQ(sums.run(progress), wholeSums);
      } catch (const Interrupted&) {
      }
    }
    Sums rest;
    ResumableRun run(folder / "a.state", "sums");
    Progress outer;
    EXPECT_EQ(rest.run(run.begin({}, outer, StateUse::Continue)), wholeSums);
    // Finished rows of the current step were too short to be kept.
    EXPECT_LE(sums.added + rest.added, 40 + 4) << looks;
    EXPECT_GE(sums.added + rest.added, 40) << looks;
  }
}

/// Whenever a process is killed, the state on disk is one that it left at some earlier moment.
TEST(KeptWork, AnyStateThatWasKept_IsGoneOnWith) {
  const test::TemporaryFolder folder;
  std::vector<std::string> states;
  ResumableRun run(folder / "a.state", "sums", 0.0, [&] {
    if (std::filesystem::exists(folder / "a.state")) states.push_back(test::readBytes(folder / "a.state"));
  });
  Progress outer;
  Sums whole;
  whole.run(run.begin({}, outer, StateUse::Replace));
  ASSERT_EQ(states.size(), 39u);
  run.remove();
  EXPECT_FALSE(std::filesystem::exists(folder / "a.state"));
  int before = 40;
  for (const std::string& state : states) {
    test::writeBytes(folder / "a.state", state);
    ResumableRun again(folder / "a.state", "sums", 0.0);
    Sums rest;
    EXPECT_EQ(rest.run(again.begin({}, outer, StateUse::Continue)), wholeSums);
    EXPECT_EQ(rest.added, --before);
  }
}

/// Work in blocks whose lengths a clock would decide: the first is 1, the others are given. `afterBlock` is
/// called when a block's own part has ended.
void workInBlocks(const Progress& progress, int length, const std::function<void()>& afterBlock) {
  int done = 0, next = 1;
  WorkPart part(progress, "blocks", [&](auto& state) {
    state.value(done);
    state.value(next);
  });
  while (done < 12) {
    std::vector<int> block(static_cast<std::size_t>(next));
    WorkPart inner(progress, "block", [&](auto& state) {
      std::size_t count = block.size();
      state.value(count);
      state.require(count == block.size());
    });
    inner.finish(true);
    afterBlock();
    done += next;
    next = length;
    part.advance();
  }
  part.finish();
}

/// A part that is kept when it ends fits what is kept of the parts around it.
TEST(KeptWork, StateAfterAPartHasEnded_FitsWorkThatIsNowFasterOrSlower) {
  const test::TemporaryFolder folder;
  std::vector<std::string> states;
  Progress outer;
  ResumableRun run(folder / "a.state", "blocks", 1e9);
  workInBlocks(run.begin({}, outer, StateUse::Replace), 3,
               [&] { states.push_back(test::readBytes(folder / "a.state")); });
  ASSERT_EQ(states.size(), 5u);
  run.remove();
  for (const std::string& state : states) {
    test::writeBytes(folder / "a.state", state);
    ResumableRun again(folder / "a.state", "blocks", 1e9);
    EXPECT_NO_THROW(workInBlocks(again.begin({}, outer, StateUse::Continue), 2, [] {}));
  }
}

TEST(KeptWork, OfAnotherName_IsNotTakenUp) {
  const test::TemporaryFolder folder;
  const auto run = [&](const char* name) {
    ResumableRun kept(folder / "a.state", "x", 0.0);
    Progress outer;
    int value = 0;
    WorkPart part(kept.begin({}, outer, StateUse::Continue), name, [&](auto& state) { state.value(value); });
    const bool finished = part.finished();
    value = 7;
    part.finish(true);
    return finished;
  };
  EXPECT_FALSE(run("one"));
  EXPECT_TRUE(run("one"));
  EXPECT_FALSE(run("other"));
}

TEST(KeptWork, InAnotherThread_IsDoneAndNotKept) {
  const test::TemporaryFolder folder;
  ResumableRun run(folder / "a.state", "sums", 0.0);
  Progress outer;
  const Progress& progress = run.begin({}, outer, StateUse::Continue);
  std::vector<int> sums;
  std::thread([&] { sums = Sums().run(progress); }).join();
  EXPECT_EQ(sums, wholeSums);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.state"));
}

/// A full disk does not make the work fail.
TEST(KeptWork, StateThatDoesNotFit_LeavesTheLastOne) {
  const test::TemporaryFolder folder;
  std::vector<int> numbers;
  std::string failure;
  const auto count = [&](Progress& progress, int until) {
    numbers.clear();
    WorkPart part(progress, "numbers", [&](auto& state) { state.values(numbers); });
    const std::size_t before = numbers.size();
    for (; static_cast<int>(numbers.size()) < until; part.advance()) {
      progress.check();
      numbers.push_back(static_cast<int>(numbers.size()));
    }
    return before;
  };
  Progress outer;
  {
    const test::FileLimit limit(2048);
    ResumableRun run(folder / "a.state", "x", 0.0);
    count(run.begin({}, outer, StateUse::Continue), 2000);
    EXPECT_FALSE(run.failure().empty());
    EXPECT_TRUE(run.hasState());
  }
  ResumableRun run(folder / "a.state", "x", 0.0);
  const std::size_t before = count(run.begin({}, outer, StateUse::Continue), 2000);
  EXPECT_GT(before, 5u);
  EXPECT_LT(before, 500u);
  EXPECT_EQ(numbers.back(), 1999);
}

TEST(KeptWork, ArrayThatGrowsWhileItIsSaved_LeavesTheLastState) {
  const test::TemporaryFolder folder;
  const StateKey key{{"work", 1}};
  Progress outer;
  bool grows = false;
  std::vector<int> array{1, 2, 3};
  const auto state = [&](auto& s) {
    if (grows) array.push_back(4);
    s.growing(array);
  };
  {
    ResumableRun run(folder / "a.state", "work", 0.0);
    Progress& progress = run.begin(key, outer, StateUse::Replace);
    WorkPart part(progress, "array", state);
    part.advance();
    run.save();
    ASSERT_EQ(run.failure(), "");
    grows = true;
    part.advance();
    run.save();
    EXPECT_NE(run.failure(), "");
  }
  grows = false;
  array.clear();
  ResumableRun again(folder / "a.state", "work", 0.0);
  const WorkPart part(again.begin(key, outer, StateUse::Continue), "array", state);
  EXPECT_EQ(array, (std::vector<int>{1, 2, 3}));
}

TEST(KeptWork, SecondsOfAllRuns_AddUp) {
  const test::TemporaryFolder folder;
  StateLog(folder / "a.state", "x", {}).commit(100.0);
  WorkKeeper keeper(std::move(*StateLog::open(folder / "a.state", "x", {})), 0.0);
  EXPECT_EQ(keeper.secondsBefore(), 100.0);
}

TEST(KeptWork, SecondsThatNoClockHolds_AreRefused) {
  for (const double seconds : {1e300, -1.0, std::nan(""), 1e10}) {
    const test::TemporaryFolder folder;
    StateLog(folder / "a.state", "x", {}).commit(seconds);
    EXPECT_THROW(WorkKeeper(std::move(*StateLog::open(folder / "a.state", "x", {})), 0.0), InputError)
        << seconds;
  }
}

}  // namespace
}  // namespace prelight
