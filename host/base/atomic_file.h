#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// Returns a name for a temporary file of this process, a few dozen letters long, which identifies the
/// process and the machine.
std::string temporaryName(int number);

/// Removes temporary files in a folder that killed processes of this machine have left. Files that may still
/// be written, and those of other machines, are kept.
void removeAbandonedFiles(const std::filesystem::path& folder);

/// A file that is moved into place when it is complete, so that nobody ever sees a partial file. Until then
/// it has no name, and nothing is left of it however the process ends; if the file system does not support
/// that, it has a short temporary name beside `path`. Symbolic links are followed, also to files that do not
/// exist yet. A replaced file passes on its permissions. A file that is not moved into place is removed.
///
/// All functions except the destructor throw Error (RuntimeFailure) "cannot write: ...", about the target.
class PendingFile {
 public:
  /// Refuses folders, devices, pipes and sockets. `permissions`: default to those of the replaced file.
  /// `shown`: what errors are about; empty: `path`.
  explicit PendingFile(const std::filesystem::path& path, std::optional<mode_t> permissions = std::nullopt,
                       const std::string& shown = {});
  PendingFile(PendingFile&& other) noexcept;
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  void write(std::span<const std::byte> bytes);

  /// Replaces bytes that have been written.
  void overwrite(std::uint64_t offset, std::span<const std::byte> bytes);

  /// To be called after the last byte: makes sure that all of them are on the disk, so that a power cut
  /// cannot take them after the older file is gone. An unnamed file keeps its descriptor.
  void close();

  /// Returns a descriptor by which the caller reads and writes the file, whether it has a name or not.
  int openAgain() const;

  /// After close(): releases the descriptor and gives the file a temporary name beside `path`.
  void takeName();

  /// Moves the file into place, after close(). With `revocable`, the replaced file is kept until this object
  /// ends.
  void moveIn(bool revocable = false);

  /// Restores what moveIn(true) replaced, if the file system can.
  void moveOut() noexcept;

 private:
  enum class State : std::uint8_t { Open, Complete, Exchanged, Created, Replaced, Gone };

  [[noreturn]] void fail(int error) const;
  void openNamed(const std::filesystem::path& folder, mode_t mode);
  bool linkTo(const std::filesystem::path& path) const;
  void closeDescriptor();

  std::string shown_;                ///< in messages
  std::filesystem::path target_;     ///< path without symbolic links
  std::filesystem::path temporary_;  ///< empty: it has no name; in state Exchanged, the replaced file
  int descriptor_ = -1;
  State state_ = State::Open;
};

/// Throws what PendingFile would throw for a place to which nothing can be written, by creating and removing
/// a temporary file there. Also removes files that killed processes have left in the folder.
void checkWritable(const std::filesystem::path& path, const std::string& shown);

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
