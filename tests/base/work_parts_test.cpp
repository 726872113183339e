#include "base/work_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "base/resumable_run.h"
#include "base/work_share.h"
#include "prelight/error.h"
#include "support/divided.h"
#include "support/gltf_files.h"
#include "support/resumed.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

/// Work of two stages: squares of numbers, then their products with the sum of all squares.
class Squares {
 public:
  std::vector<int> run(Progress& progress) {
    const std::vector<int> squares = stage(progress, "squares", [](int i) { return i * i; });
    const int sum = std::accumulate(squares.begin(), squares.end(), 0);
    return stage(progress, "products", [&](int i) { return squares[static_cast<std::size_t>(i)] * sum; });
  }

  int computed = 0;

 private:
  static constexpr int count = 23;

  std::vector<int> stage(Progress& progress, const char* name, const std::function<int(int)>& valueOf) {
    std::vector<int> values;
    WorkPart part(progress, name, [&](auto& state) { state.growing(values); });
    if (part.finished()) return values;
    SharedLoop loop(part, name);
    while (values.size() < count) {
      progress.check();
      const int i = static_cast<int>(values.size());
      int value = 0;
      loop.run(
          {values.size(), 1},
          [&] {
            value = valueOf(i);
            ++computed;
          },
          [&](auto& state) { state.value(value); });
      values.push_back(value);
      part.advance();
    }
    loop.end();
    part.finish();
    return values;
  }
};

std::vector<int> wholeSquares() {
  Squares squares;
  Progress progress;
  return squares.run(progress);
}

/// Files of a piece of work, whose processes come one after the other.
class Processes {
 public:
  /// Runs a slice and returns the pieces that it has computed.
  int slice(const std::string& name, SliceChoice choice, const StateKey& key = {}) const {
    Squares squares;
    WorkSlice share(folder_ / name, "test", key, choice, {"bake", "a.glb"});
    ResumableRun run(folder_ / "a.state", "test");
    Progress outer;
    EXPECT_THROW(squares.run(run.begin(key, outer, StateUse::Read, &share)), StageEnd);
    return squares.computed;
  }

  /// Merges files and returns the result, or nothing where a stage is left.
  std::vector<int> merge(const std::vector<std::string>& names, const StateKey& key = {},
                         bool anyDevice = false) {
    std::vector<fs::path> paths;
    for (const std::string& name : names) paths.push_back(folder_ / name);
    GivenParts given(paths, "test", key, anyDevice);
    ResumableRun run(folder_ / "a.state", "test");
    Progress outer;
    Squares squares;
    std::vector<int> result;
    try {
      result = squares.run(run.begin(key, outer, StateUse::Continue, &given));
    } catch (const StageEnd& end) {
      next = end.stage;
    }
    here = given.here();
    return result;
  }

  fs::path path(const std::string& name) const { return folder_ / name; }

  std::string next;
  std::uint64_t here = 0;

 private:
  test::TemporaryFolder folder_;
};

TEST(DividedWork, InAnyNumberOfSlices_IsThatOfOneProcess) {
  for (const std::uint32_t slices : {1u, 2u, 7u, 64u}) {
    SCOPED_TRACE(slices);
    test::DividedWork divided(slices);
    Squares squares;
    EXPECT_EQ(divided.run([&](Progress& progress) { return squares.run(progress); }), wholeSquares());
    EXPECT_EQ(squares.computed, 2 * 23);
    EXPECT_THAT(divided.stages(), ElementsAre("squares", "products"));
  }
}

TEST(DividedWork, SlicesLost_IsThatOfOneProcess) {
  test::DividedWork divided(7, 0.5);
  EXPECT_EQ(divided.run([](Progress& progress) { return Squares().run(progress); }), wholeSquares());
  EXPECT_GT(divided.here(), 0u);
}

TEST(DividedWork, SliceDoneAgain_ComputesNothing) {
  const Processes processes;
  EXPECT_EQ(processes.slice("1.part", {1, 2}), 11);
  EXPECT_EQ(processes.slice("1.part", {1, 2}), 0);
}

TEST(DividedWork, SliceInterrupted_GoesOnWithWhatItHas) {
  const test::TemporaryFolder folder;
  int computed = 0;
  for (int run = 0; run < 2; ++run) {
    Squares squares;
    WorkSlice share(folder / "1.part", "test", {}, {1, 1}, {});
    ResumableRun kept(folder / "a.state", "test");
    test::StopAfterLooks stops(run == 0 ? 10 : 1000);
    Progress& progress = kept.begin({}, stops, StateUse::Read, &share);
    if (run == 0)
      EXPECT_THROW(squares.run(progress), Interrupted);
    else
      EXPECT_THROW(squares.run(progress), StageEnd);
    EXPECT_GT(squares.computed, 0);
    computed += squares.computed;
  }
  EXPECT_EQ(computed, 23);
}

TEST(DividedWork, SliceWithoutPieces_StandsForItsStage) {
  Processes processes;
  EXPECT_EQ(processes.slice("64.part", {64, 64}), 0);
  processes.merge({"64.part"});
  EXPECT_EQ(processes.next, "products");
  EXPECT_EQ(processes.here, 23u);
}

TEST(DividedWork, SlicesThatOverlap_AreTakenOnce) {
  Processes processes;
  processes.slice("1.part", {1, 2});
  processes.slice("all.part", {1, 1});
  processes.slice("2.part", {2, 2});
  EXPECT_TRUE(processes.merge({"2.part", "all.part", "1.part"}).empty());
  EXPECT_EQ(processes.next, "products");
  EXPECT_EQ(processes.here, 0u);
}

TEST(DividedWork, FileWithoutItsEnd_GivesWhatWasCommittedBefore) {
  Processes processes;
  processes.slice("1.part", {1, 1});
  fs::resize_file(processes.path("1.part"), fs::file_size(processes.path("1.part")) - 1);
  processes.merge({"1.part"});
  EXPECT_EQ(processes.next, "products");
  EXPECT_EQ(processes.here, 23u);
}

TEST(DividedWork, FileOfFewBytes_IsRefused) {
  Processes processes;
  processes.slice("1.part", {1, 1});
  fs::resize_file(processes.path("1.part"), 40);
  EXPECT_THROW(processes.merge({"1.part"}), InputError);
}

TEST(DividedWork, FileOfOtherWork_IsRefusedByName) {
  Processes processes;
  processes.slice("1.part", {1, 1}, {{"seed", 1}, {"device", 1}});
  try {
    processes.merge({"1.part"}, {{"seed", 2}, {"device", 1}});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("another seed"));
  }
}

TEST(DividedWork, FileOfAnotherDevice_IsTakenOnlyWhereThatIsAskedFor) {
  Processes processes;
  processes.slice("1.part", {1, 1}, {{"seed", 1}, {"device", 1}});
  EXPECT_THROW(processes.merge({"1.part"}, {{"seed", 1}, {"device", 2}}), UsageError);
  EXPECT_NO_THROW(processes.merge({"1.part"}, {{"seed", 1}, {"device", 2}}, true));
  EXPECT_EQ(processes.next, "products");
}

TEST(DividedWork, FileThatIsNone_IsRefused) {
  Processes processes;
  test::writeBytes(processes.path("1.part"), "glTF");
  EXPECT_THROW(processes.merge({"1.part"}), InputError);
  EXPECT_THROW(processes.merge({"no.part"}), InputError);
}

TEST(DividedWork, SliceOfAnotherStage_DoesNotGoIntoTheSameFile) {
  Processes processes;
  processes.slice("1.part", {1, 1});
  processes.merge({"1.part"});
  Squares squares;
  WorkSlice share(processes.path("1.part"), "test", {}, {1, 1}, {});
  ResumableRun run(processes.path("a.state"), "test");
  Progress outer;
  EXPECT_THROW(squares.run(run.begin({}, outer, StateUse::Read, &share)), UsageError);
}

TEST(DividedWork, Title_SaysWhatTheSliceWasAskedFor) {
  const Processes processes;
  processes.slice("3.part", {3, 5});
  const PartTitle title = readPartTitle(processes.path("3.part"));
  EXPECT_EQ(title.stage, "squares");
  EXPECT_EQ(title.slice.index, 3u);
  EXPECT_EQ(title.slice.count, 5u);
  EXPECT_THAT(title.arguments, ElementsAre("bake", "a.glb"));
}

}  // namespace
}  // namespace prelight
