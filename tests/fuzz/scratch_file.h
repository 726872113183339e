#pragma once

#include <filesystem>

#include "fuzz/target.h"

namespace prelight::fuzz {

/// A new and empty folder, which only this user may enter. It is removed with the object.
class ScratchFolder {
 public:
  /// Throws std::system_error when there can be none.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// A file in a folder of its own. Both are removed with the object.
class ScratchFile {
 public:
  /// `name` is the file's, with its extension. Throws std::system_error when it cannot be written.
  ScratchFile(const char* name, Bytes content);

  const std::filesystem::path& path() const { return path_; }

 private:
  ScratchFolder folder_;
  std::filesystem::path path_;
};

}  // namespace prelight::fuzz
