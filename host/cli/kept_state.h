#pragma once

#include <filesystem>
#include <string>

#include "base/resumable_run.h"
#include "cli/console.h"
#include "cli/stop_signals.h"

namespace prelight::cli {

/// The state of a command in a file beside its output, and what people are told of it.
class KeptState {
 public:
  /// `kind`: what is made, as "bake". With `resume`, a state that is there is gone on with.
  KeptState(const std::filesystem::path& output, const std::string& kind, bool resume, const Console& console,
            StopSignals& signals);

  /// The progress that the work is to have. Throws as StateLog::open().
  Progress& begin(const StateKey& key, Progress& outer);

  /// After begin(): the progress that it returned.
  Progress& progress() { return *progress_; }

  /// Keeps what is done, where none of the work is going on.
  void save() { run_.save(); }

  /// Takes the state away once the output is there.
  void remove();

  /// What to tell someone who has interrupted the work.
  std::string message() const;

 private:
  void tellOfSave();

  ResumableRun run_;
  std::string kind_;
  bool resume_;
  const Console& console_;
  StopSignals& signals_;
  Progress* progress_ = nullptr;
  bool warned_ = false;
};

}  // namespace prelight::cli
