#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cli/console.h"
#include "cli/stop_signals.h"
#include "library/file_checkpoint.h"

namespace prelight::cli {

/// The state of a bake in a file beside its output.
class BakeStateFile final : public BakeCheckpoint {
 public:
  /// With `resume`, a state that is there is continued.
  BakeStateFile(const std::filesystem::path& output, bool resume, const Console& console,
                StopSignals& signals);

  /// What a state must belong to; needed before load() and save().
  void setKey(StateKey key) { file_.setKey(std::move(key)); }

  std::optional<StateReader> load() override;
  void save(const std::function<void(StateWriter&)>& write) override;

  /// Takes the state away once the output is there.
  void remove() const { file_.remove(); }

  /// What to tell someone who has interrupted the bake.
  std::string message() const;

 private:
  FileCheckpoint file_;
  bool resume_;
  const Console& console_;
  StopSignals& signals_;
  bool saved_ = false;
};

}  // namespace prelight::cli
