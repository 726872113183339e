#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "base/pending_file.h"

namespace prelight {

/// Whether files are written, or only their bytes are counted.
enum class FileWork : std::uint8_t { Write, Count };

/// Files that belong together: all of them are written to temporary files before the first is moved into
/// place. If one cannot be moved, those before it are restored, as far as the file system can exchange files.
class OutputFiles {
 public:
  OutputFiles() = default;

  /// Writes files of a folder. The folder's last part is created if it is missing, and removed again without
  /// commit(). Empty: files in existing folders.
  explicit OutputFiles(const std::filesystem::path& folder, FileWork work = FileWork::Write);
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles();

  /// Writes bytes, one piece after the other, to a temporary file for `path`. Throws as PendingFile does.
  void add(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces);
  void add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    add(path, std::span(&bytes, 1));
  }

  /// Moves all files into place, in the order in which they were added.
  void commit();

  /// Returns the bytes of the file that was added for this path; 0 if there is none.
  std::uint64_t bytesOf(const std::filesystem::path& path) const;

 private:
  FileWork work_ = FileWork::Write;
  std::map<std::filesystem::path, std::uint64_t> bytes_;
  std::vector<PendingFile> files_;
  std::filesystem::path madeFolder_;  ///< folder that was created; empty: none
};

/// Writes a single file: to a temporary file, which is then moved to `path`.
void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces);

}  // namespace prelight
