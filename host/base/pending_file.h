#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace prelight {

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

  /// To be called after the last byte: makes sure that the file system has accepted all of them. An unnamed
  /// file keeps its descriptor.
  void close();

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

}  // namespace prelight
