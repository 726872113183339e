#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bake/baker.h"

namespace prelight {

/// A bake's state in a file.
class FileCheckpoint final : public BakeCheckpoint {
 public:
  FileCheckpoint(std::filesystem::path path, StateKey key);

  /// Throws as readStateFile.
  std::optional<StateReader> load() override;

  /// Remembers what kept it from saving: neither a full disk nor little memory ends a bake.
  void save(const std::function<void(StateWriter&)>& write) override;

  /// Deletes the file.
  void remove() const;

  /// Why the state could not be kept when it was last to be; empty: it could.
  const std::string& failure() const { return failure_; }

 private:
  std::filesystem::path path_;
  StateKey key_;
  std::string failure_;
};

}  // namespace prelight
