#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/resumable_run.h"
#include "base/work_parts.h"
#include "support/gltf_files.h"

namespace prelight::test {

/// Work that is divided into slices, each of which is done as by a process of its own, stage by stage.
class DividedWork {
 public:
  /// Slices are lost with the probability `lost`, and then their pieces are computed where all are merged.
  explicit DividedWork(std::uint32_t slices, double lost = 0.0) : slices_(slices), lost_(lost) {}

  /// Returns the result of work(progress).
  template <typename Work>
  auto run(const Work& work) {
    constexpr int mostStages = 200;
    for (int stage = 0; stage < mostStages; ++stage) {
      const std::vector<std::filesystem::path> parts = doSlices(work, stage);
      GivenParts given(parts, "test", {}, false);
      ResumableRun run(state_, "test");
      Progress outer;
      Progress& progress = run.begin({}, outer, StateUse::Continue, &given);
      try {
        auto result = work(progress);
        count(given);
        return result;
      } catch (const StageEnd&) {
        count(given);
      }
    }
    throw std::runtime_error("the work does not come to its end");
  }

  const std::vector<std::string>& stages() const { return stages_; }
  std::uint64_t here() const { return here_; }  ///< pieces that no slice had

 private:
  template <typename Work>
  std::vector<std::filesystem::path> doSlices(const Work& work, int stage) {
    std::vector<std::filesystem::path> parts;
    for (std::uint32_t i = 1; i <= slices_; ++i) {
      const bool last = i == slices_ && parts.empty();
      if (!last && std::uniform_real_distribution<>()(random_) < lost_) continue;
      const std::filesystem::path part =
          folder_ / (std::to_string(stage) + "-" + std::to_string(i) + ".part");
      WorkSlice slice(part, "test", {}, {i, slices_}, {});
      ResumableRun run(state_, "test");
      Progress outer;
      EXPECT_THROW((void)work(run.begin({}, outer, StateUse::Read, &slice)), StageEnd);
      parts.push_back(part);
    }
    std::shuffle(parts.begin(), parts.end(), random_);
    return parts;
  }

  void count(const GivenParts& given) {
    here_ += given.here();
    stages_.insert(stages_.end(), given.stages().begin(), given.stages().end());
  }

  TemporaryFolder folder_;
  std::filesystem::path state_ = folder_ / "a.state";
  std::uint32_t slices_;
  double lost_;
  std::mt19937 random_{7};
  std::vector<std::string> stages_;
  std::uint64_t here_ = 0;
};

}  // namespace prelight::test
