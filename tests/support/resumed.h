#pragma once

#include <gtest/gtest.h>

#include "base/resumable_run.h"
#include "prelight/error.h"
#include "support/gltf_files.h"

namespace prelight::test {

/// Asks to stop at the `looks`-th check.
class StopAfterLooks final : public Progress {
 public:
  explicit StopAfterLooks(int looks) : left_(looks) {}
  bool stopRequested() const override { return left_ <= 0 || --left_ <= 0; }

 private:
  mutable int left_;
};

/// Result of work that is stopped again and again, after an increasing number of checks, and resumed from its
/// state.
template <typename Work>
auto inManyRuns(const Work& work, int firstLooks = 2) {
  const TemporaryFolder folder;
  for (int looks = firstLooks;; looks += 1 + looks / 8) {
    ResumableRun run(folder / "a.state", "test", 0.0, [&] { EXPECT_EQ(run.failure(), ""); });
    StopAfterLooks stops(looks);
    Progress& progress = run.begin({}, stops, StateUse::Continue);
    try {
      return work(progress);
    } catch (const Interrupted&) {
    }
  }
}

}  // namespace prelight::test
