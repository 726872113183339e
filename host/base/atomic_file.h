#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "base/pending_file.h"

namespace prelight {

/// Whether files are written or what they would be is counted.
enum class FileWork : std::uint8_t { Write, Count };

/// Files that belong together: all of them are written beside their places before the first takes its own.
/// Where one cannot, those before it are taken back as far as the file system can exchange files.
class OutputFiles {
 public:
  OutputFiles() = default;

  /// Files of a folder, which is made where its last part is missing, and gone again without commit(). Empty:
  /// of folders that are there.
  explicit OutputFiles(const std::filesystem::path& folder, FileWork work = FileWork::Write);
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles();

  /// Writes bytes, one piece after the other, beside `path`. Throws as PendingFile does.
  void add(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces);
  void add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    add(path, std::span(&bytes, 1));
  }

  /// Moves all into their places, in the order in which they were added.
  void commit();

  /// Bytes of the file that was added by this path; 0 where none was.
  std::uint64_t bytesOf(const std::filesystem::path& path) const;

 private:
  FileWork work_ = FileWork::Write;
  std::map<std::filesystem::path, std::uint64_t> bytes_;
  std::vector<PendingFile> files_;
  std::filesystem::path madeFolder_;  ///< empty: none was made
};

/// One file of its own: writes beside `path`, then renames.
void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces);

}  // namespace prelight
