#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "base/pending_file.h"

namespace prelight {

/// Files that belong together: all of them are written beside their places before the first takes its own.
/// Where one cannot, those before it are taken back as far as the file system can exchange files.
class OutputFiles {
 public:
  /// Writes bytes, one piece after the other, beside `path`. Throws as PendingFile does.
  void add(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces);
  void add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    add(path, std::span(&bytes, 1));
  }

  /// Moves all into their places, in the order in which they were added.
  void commit();

 private:
  std::vector<PendingFile> files_;
};

/// One file of its own: writes beside `path`, then renames.
void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces);

}  // namespace prelight
