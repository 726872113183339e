#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/kept_work.h"
#include "prelight/progress.h"

namespace prelight {

/// Seconds between two states of a run that nobody interrupts, at most: with the work between two looks at
/// the clock, a state is never older than half a minute.
constexpr double usualStateInterval = 25.0;

/// The progress of work that is kept now and then, for runs that end without a warning, and when it is asked
/// to stop. Wherever work asks whether to stop it could be told so, and its state can be kept there.
///
/// States come ever rarer, up to `interval` seconds apart. Before that they take a fiftieth of the time at
/// most.
class KeepingProgress final : public Progress {
 public:
  /// `outer` and `keeper` outlive it. `saved` is called after every save. An interval of 0 saves always.
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

/// A run of work that leaves its state in a file, and goes on with that of an earlier run.
class ResumableRun {
 public:
  /// `kind`: as of StateLog. `saved`, if there is one, is called after every attempt to keep the state.
  ResumableRun(std::filesystem::path path, std::string kind, double interval = usualStateInterval,
               std::function<void()> saved = {});

  /// The progress that the work is to have, which reports to `outer`. With `goOn`, the state that is there is
  /// gone on with. Throws as StateLog::open().
  Progress& begin(const StateKey& key, Progress& outer, bool goOn);

  /// True where begin() found a state.
  bool goesOn() const { return goesOn_; }

  /// After begin(): there is a state.
  bool hasState() const { return keeper_ && keeper_->hasState(); }

  /// After begin(): why the state could not be kept when it was last to be; empty: it could.
  std::string failure() const { return keeper_ ? keeper_->failure() : std::string(); }

  /// Keeps what is done, where no part of the work is being changed.
  void save();

  const std::filesystem::path& path() const { return path_; }

  /// Takes the state away once the work is done.
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
