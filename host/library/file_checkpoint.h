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
  explicit FileCheckpoint(std::filesystem::path path);

  /// What a state must belong to; needed before load() and save().
  void setKey(StateKey key) { key_ = std::move(key); }

  /// Throws as readStateFile.
  std::optional<StateReader> load() override;

  /// Remembers what kept it from saving: neither a full disk nor little memory ends a bake.
  void save(const std::function<void(StateWriter&)>& write) override;

  const std::filesystem::path& path() const { return path_; }

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
