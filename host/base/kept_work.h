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

/// Keeps what long work has done, so that another process goes on with it. The work says what that is by
/// parts (WorkPart), which lie within one another like the calls of the functions that have them. A process
/// that goes on runs the same functions from the start: parts that were finished give their results back at
/// once, those that were under way give back how far they were, and everything that no part keeps is done
/// again. The work must therefore do the same every time it is run.
///
/// A state that cannot be kept is no reason to end the work: the last one that could stays as it is.
class WorkKeeper {
 public:
  /// What is lost of finished parts that were not worth keeping is at most `mostUnkept` seconds of work,
  /// altogether.
  WorkKeeper(StateLog log, double mostUnkept);
  WorkKeeper(const WorkKeeper&) = delete;
  WorkKeeper& operator=(const WorkKeeper&) = delete;

  /// Keeps all parts as they are. Only whoever owns them may call it, where no part is being changed.
  /// `always`: also where none has changed, so that there is a state.
  void save(bool always = false);

  /// True in the thread that made it: all parts are of this one.
  bool ownsThisThread() const { return std::this_thread::get_id() == thread_; }

  /// Work that earlier runs have put into the state, s.
  double secondsBefore() const { return secondsBefore_; }

  /// True once there is a state in the file, by this run or an earlier one.
  bool hasState() const { return hasState_; }

  /// Why the last save failed; empty: it did not.
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
  double mostUnkept_;
  double secondsBefore_;
  Clock::time_point start_ = Clock::now();
  std::thread::id thread_ = std::this_thread::get_id();
  std::vector<WorkPart*> parts_;  ///< those that live, each within the one before
  std::uint32_t rootChildren_ = 0;
  double unkept_ = 0.0;  ///< s of finished parts that no part which lives or was kept covers
  std::string failure_;
  bool hasState_;
};

/// A part of long work: what it has done so far, while it lives, and its result, once it is finished. Where
/// nobody keeps the work it does nothing.
///
/// `state` is called with a StateWriter& or a StateReader&, and has them write or read the same in the same
/// order. What it writes must be right whenever the work asks whether to stop, and at the start of the part
/// everything must be as it was before: what it reads is put in place by the constructor.
///
/// Work that other parts take part in consists of steps. Within a step the state stays as it was at the
/// step's start, and the parts inside are always made in the same order.
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

  /// True where an earlier run has finished it: the state is the result, and nothing is left to do.
  bool finished() const { return finished_; }

  /// Ends a step: the state has changed.
  void advance();

  /// Ends the part, whose state is its result. It is kept where it took long to make, or `always`: where it
  /// would not be the same if it were made again.
  void finish(bool always = false);

 private:
  friend class WorkKeeper;

  WorkPart(WorkKeeper* keeper, std::string_view name, std::function<void(StateWriter&)> save,
           std::function<void(StateReader&)> load);

  WorkKeeper* keeper_;  ///< nullptr: nobody keeps the work
  std::function<void(StateWriter&)> save_;
  std::function<void(StateReader&)> load_;
  std::string name_;  ///< of its record, which those of parts inside begin with
  std::chrono::steady_clock::time_point born_ = std::chrono::steady_clock::now();
  std::uint64_t step_ = 0;
  std::uint64_t keptStep_ = 0;
  std::uint32_t children_ = 0;  ///< of this step, so far
  double unkeptInside_ = 0.0;   ///< s of parts of this step that are finished and were not kept
  bool finished_ = false;
  bool changed_ = false;  ///< since it was kept
  bool kept_ = false;
};

/// The state of something that has save() and load().
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
