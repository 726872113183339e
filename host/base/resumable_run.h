#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/kept_work.h"
#include "prelight/progress.h"

namespace prelight {

/// Longest time between two states of an uninterrupted run, s: including the work between two looks at the
/// clock, a state is never older than half a minute.
constexpr double usualStateInterval = 25.0;

/// Progress of work that is saved from time to time, because runs may end without warning, and when the work
/// is asked to stop. States are saved where the work asks whether to stop.
///
/// States become rarer, up to `interval` seconds apart; before that, saving takes at most a fiftieth of the
/// time.
class KeepingProgress final : public Progress {
 public:
  /// `outer` and `keeper` must outlive this object. `saved` is called after every save. An interval of 0
  /// saves at every opportunity.
  KeepingProgress(Progress& outer, WorkKeeper& keeper, double interval, std::function<void()> saved);

  void report(std::string_view stage, double fraction) override { outer_.report(stage, fraction); }
  void compiling(const KernelCompilation& program) override { outer_.compiling(program); }
  void warn(std::string_view warning) override { outer_.warn(warning); }
  bool stopRequested() const override;
  WorkKeeper* keeper() const override { return &keeper_; }

 private:
  using Clock = std::chrono::steady_clock;

  Progress& outer_;
  WorkKeeper& keeper_;
  double interval_;
  std::function<void()> saved_;
  mutable double wait_;
  mutable Clock::time_point next_;
  mutable bool keptForStop_ = false;
};

/// The use that a run makes of a state that is there.
enum class StateUse : std::uint8_t {
  Replace,   ///< starts from the beginning and saves its own
  Continue,  ///< goes on from it and saves what comes of it
  Read,      ///< goes on from it and saves nothing
};

/// A run of work that saves its state in a file, and can continue from an earlier run's.
class ResumableRun {
 public:
  /// `kind`: as in StateLog. `saved`, if given, is called after every attempt to save the state.
  ResumableRun(std::filesystem::path path, std::string kind, double interval = usualStateInterval,
               std::function<void()> saved = {});

  /// Returns the progress for the work, which reports to `outer`. `share`, if given, divides the work among
  /// processes and must outlive it. Throws as StateLog::open(), and UsageError if another run is going on
  /// with the state that would be replaced.
  Progress& begin(const StateKey& key, Progress& outer, StateUse use, WorkShare* share = nullptr);

  /// Returns true if begin() found a state.
  bool goesOn() const { return goesOn_; }

  /// Returns true, after begin(), if there is a state.
  bool hasState() const { return keeper_ && keeper_->hasState(); }

  /// Returns, after begin(), why the last attempt to save the state failed; empty if it did not.
  std::string failure() const { return keeper_ ? keeper_->failure() : std::string(); }

  /// Saves the state; no part of the work may be changing.
  void save();

  const std::filesystem::path& path() const { return path_; }

  /// Removes the state once the work is done, unless another run is continuing it.
  void remove();

 private:
  std::filesystem::path path_;
  std::string kind_;
  double interval_;
  std::function<void()> saved_;
  bool goesOn_ = false;
  std::optional<WorkKeeper> keeper_;
  std::optional<KeepingProgress> progress_;
};

}  // namespace prelight
