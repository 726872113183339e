#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/state_log.h"
#include "prelight/progress.h"

namespace prelight {

class WorkPart;
class WorkShare;

/// Saves the progress of long work, so that another process can continue it. The work describes its progress
/// by parts (WorkPart), which are nested like the calls of the functions that have them. A process that
/// continues runs the same functions from the start: finished parts restore their results at once, unfinished
/// ones restore their progress, and everything that no part saves is repeated. The work must therefore do the
/// same in every run.
///
/// Failing to save a state does not end the work: the last saved one is kept.
class WorkKeeper {
 public:
  /// `mostUnkept`: greatest total time, s, of finished parts whose results are not saved and may be lost.
  /// `readOnly`: what the log has is restored, and nothing is saved.
  WorkKeeper(StateLog log, double mostUnkept, bool readOnly = false);
  WorkKeeper(const WorkKeeper&) = delete;
  WorkKeeper& operator=(const WorkKeeper&) = delete;

  /// Has the work's loops divided among processes by `share`, which must outlive it. nullptr: they are not.
  void divide(WorkShare* share) { share_ = share; }
  WorkShare* share() const { return share_; }

  /// Saves all parts as they are. Only the thread that owns them may call it, while no part is being changed.
  /// `always`: also if no part has changed, so that there is a state.
  void save(bool always = false);

  /// Returns true in the thread that created this object, to which all parts belong.
  bool ownsThisThread() const { return std::this_thread::get_id() == thread_; }

  /// Returns the time of work by earlier runs in the state, s.
  double secondsBefore() const { return secondsBefore_; }

  /// Returns true once the file has a state, by this run or an earlier one.
  bool hasState() const { return hasState_; }

  /// Returns why the last save failed; empty if it did not.
  const std::string& failure() const { return failure_; }

  const std::filesystem::path& path() const { return log_.path(); }

 private:
  friend class WorkPart;
  using Clock = std::chrono::steady_clock;

  std::string nameOfNext(std::string_view name);
  void load(WorkPart& part);
  void write(WorkPart& part);
  bool commit(const std::function<void()>& writeAll);
  bool saveChanged();
  void finish(WorkPart& part, bool always);
  double seconds() const;

  StateLog log_;
  bool readOnly_;
  WorkShare* share_ = nullptr;
  double mostUnkept_;
  double secondsBefore_;
  Clock::time_point start_ = Clock::now();
  std::thread::id thread_ = std::this_thread::get_id();
  std::vector<WorkPart*> parts_;  ///< existing parts, each within the previous one
  std::uint32_t rootChildren_ = 0;
  double unkept_ = 0.0;  ///< s of finished parts that are covered by no existing or saved part
  std::string failure_;
  bool hasState_;
};

/// A part of long work: its progress while it exists, and its result once it is finished. Does nothing where
/// no WorkKeeper is used.
///
/// `state` is called with a StateWriter& or a StateReader&, and must write or read the same values in the
/// same order. What it writes must be valid whenever the work asks whether to stop. At the start of the part
/// everything must be as it was before, because the constructor puts what it reads in place.
///
/// Work that contains other parts consists of steps. Within a step the state stays as it was at the step's
/// start, and the inner parts are always created in the same order.
class WorkPart {
 public:
  template <typename State>
  WorkPart(const Progress& progress, std::string_view name, State state)
      : WorkPart(
            progress.keeper(), name, [state](StateWriter& writer) mutable { state(writer); },
            [state](StateReader& reader) mutable { state(reader); }) {}
  WorkPart(const WorkPart&) = delete;
  WorkPart& operator=(const WorkPart&) = delete;
  ~WorkPart();

  /// Returns true if an earlier run has finished the part: the state is the result, and nothing is left to
  /// do.
  bool finished() const { return finished_; }

  /// Ends a step, after which the state has changed.
  void advance();

  /// Ends the part, whose state is its result. The result is saved if it took long, or with `always`: if
  /// repeating the work would not give the same result.
  void finish(bool always = false);

  /// Returns what keeps the part, or nullptr, and its name there: that of all parts around it and its own.
  WorkKeeper* keeper() const { return keeper_; }
  const std::string& name() const { return name_; }

 private:
  friend class WorkKeeper;

  WorkPart(WorkKeeper* keeper, std::string_view name, std::function<void(StateWriter&)> save,
           std::function<void(StateReader&)> load);

  WorkKeeper* keeper_;  ///< nullptr: progress is not saved
  std::function<void(StateWriter&)> save_;
  std::function<void(StateReader&)> load_;
  std::string name_;  ///< name of its record, with which the names of inner parts begin
  std::chrono::steady_clock::time_point born_ = std::chrono::steady_clock::now();
  std::uint64_t step_ = 0;
  std::uint64_t keptStep_ = 0;
  std::uint32_t children_ = 0;  ///< inner parts of this step so far
  double unkeptInside_ = 0.0;   ///< s of finished inner parts of this step that were not saved
  bool finished_ = false;
  bool changed_ = false;  ///< since it was last saved
  bool kept_ = false;
};

/// Returns a state function for an object that has save() and load().
template <typename What>
auto keptBy(What& what) {
  return [&what](auto& state) {
    if constexpr (std::is_same_v<std::decay_t<decltype(state)>, StateWriter>)
      what.save(state);
    else
      what.load(state);
  };
}

}  // namespace prelight
