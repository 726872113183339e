#pragma once

#include <chrono>
#include <functional>
#include <string_view>

#include "prelight/progress.h"

namespace prelight {

/// The progress of work that keeps its state now and then, for runs that end without a warning. Wherever work
/// asks whether to stop it could be told so, and its state can be saved there.
///
/// Saves come ever rarer, up to `interval` seconds apart, and take a hundredth of the time at most: the first
/// waits a hundred times what it is expected to take, and after a slow one, the next waits a hundred times as
/// long.
class SavingProgress final : public Progress {
 public:
  /// `outer` outlives it. `expected`: the seconds that the first save will take. An interval of 0 saves
  /// always.
  SavingProgress(Progress& outer, double interval, double expected, std::function<void()> save);

  void report(std::string_view stage, double fraction) override { outer_.report(stage, fraction); }
  bool stopRequested() const override;

 private:
  using Clock = std::chrono::steady_clock;

  Progress& outer_;
  double interval_;
  std::function<void()> save_;
  mutable double wait_;
  mutable Clock::time_point next_;
};

}  // namespace prelight
