#pragma once

#include <filesystem>
#include <string>

#include "bake/baker.h"
#include "cli/console.h"

namespace prelight::cli {

/// The state of an interrupted bake in a file beside its output.
class BakeStateFile final : public BakeCheckpoint {
 public:
  /// With `resume`, a state that is there is continued.
  BakeStateFile(const std::filesystem::path& output, bool resume, const Console& console);

  /// What a state must belong to; needed before load() and save().
  void setKey(StateKey key) { key_ = std::move(key); }

  std::optional<StateReader> load() override;
  void save(std::span<const std::byte> payload) override;

  /// Takes the state away once the output is there.
  void remove() const;

  /// What to tell someone who has interrupted the bake.
  std::string message() const;

 private:
  std::filesystem::path path_;
  bool resume_;
  const Console& console_;
  StateKey key_;
  bool saved_ = false;
  std::string failure_;
};

}  // namespace prelight::cli
