#pragma once

#include <filesystem>
#include <string>

#include "base/resumable_run.h"
#include "cli/console/console.h"
#include "cli/console/stop_signals.h"

namespace prelight::cli {

/// Keeps the state of a command in a file beside its output and tells people about it.
class KeptState {
 public:
  /// `kind` names the output, such as "bake". With `resume`, work continues from a state that is there.
  KeptState(const std::filesystem::path& output, const std::string& kind, bool resume, const Console& console,
            StopSignals& signals);

  /// Returns the progress that the work has to use. Throws as StateLog::open() does.
  Progress& begin(const StateKey& key, Progress& outer);

  /// The progress that begin() returned.
  Progress& progress() { return *progress_; }

  /// Saves the state. It must be called while none of the work is running.
  void save() { run_.save(); }

  /// Removes the state once the output is complete.
  void remove();

  /// Returns the text for someone who has interrupted the work.
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
