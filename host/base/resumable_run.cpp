#include "base/resumable_run.h"

#include <algorithm>
#include <utility>

#include "base/file_lock.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr double firstShare = 1.0 / 5.0;  // first interval, as a share of the longest
constexpr double leastRatio =
    // Least ratio of the time between states to the time that saving one takes, if the interval permits it.
    50.0;
constexpr double unkeptShare = 1.0 / 5.0;  // share of the interval: work of finished parts that may be lost

std::chrono::steady_clock::duration duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

KeepingProgress::KeepingProgress(Progress& outer, WorkKeeper& keeper, double interval,
                                 std::function<void()> saved)
    : outer_(outer),
      keeper_(keeper),
      interval_(interval),
      saved_(std::move(saved)),
      wait_(interval * firstShare),
      next_(Clock::now() + duration(wait_)) {}

bool KeepingProgress::stopRequested() const {
  const bool stops = outer_.stopRequested();
  const Clock::time_point start = Clock::now();
  if (!keeper_.ownsThisThread() || (stops ? keptForStop_ : start < next_)) return stops;
  keptForStop_ = stops;
  keeper_.save(stops);
  if (saved_) saved_();
  const Clock::time_point end = Clock::now();
  wait_ = std::min(2.0 * wait_, interval_);
  const double rare = leastRatio * std::chrono::duration<double>(end - start).count();
  next_ = end + duration(std::clamp(rare, wait_, interval_));
  return stops;
}

ResumableRun::ResumableRun(std::filesystem::path path, std::string kind, double interval,
                           std::function<void()> saved)
    : path_(std::move(path)), kind_(std::move(kind)), interval_(interval), saved_(std::move(saved)) {}

Progress& ResumableRun::begin(const StateKey& key, Progress& outer, StateUse use, WorkShare* share) {
  if (use == StateUse::Replace && isLockedByAnother(path_))
    throw UsageError(path_.string(), "another run that writes the same output goes on with it",
                     "wait for that run, end it, or write to another file");
  const auto access = use == StateUse::Read ? StateLog::Access::Read : StateLog::Access::Continue;
  std::optional<StateLog> log =
      use == StateUse::Replace ? std::nullopt : StateLog::open(path_, kind_, key, access);
  goesOn_ = log.has_value();
  keeper_.emplace(log ? std::move(*log) : StateLog(path_, kind_, key), interval_ * unkeptShare,
                  use == StateUse::Read);
  keeper_->divide(share);
  return progress_.emplace(outer, *keeper_, interval_, saved_);
}

void ResumableRun::save() {
  if (!keeper_) return;
  keeper_->save();
  if (saved_) saved_();
}

void ResumableRun::remove() {
  progress_.reset();
  keeper_.reset();
  removeUnlessLocked(path_);
}

}  // namespace prelight
