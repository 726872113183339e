#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace prelight {

/// A file on its way to its place, which it takes when it is complete: nobody ever sees half a file. Until
/// then it has no name, so that nothing is left of it however the process ends; where the file system knows
/// no such files, it has a short one of its own beside `path`. A symbolic link is followed, also where it
/// leads to a file that is not there yet. A file that is replaced hands its permissions on. What is not moved
/// in is removed again.
///
/// All but the destructor throw Error (RuntimeFailure) "cannot write: ...", about what is written.
class PendingFile {
 public:
  /// Refuses folders, devices, pipes and sockets. `permissions`: of the file that is replaced, unless they
  /// are given. Errors are about `shown`; empty: about `path`.
  explicit PendingFile(const std::filesystem::path& path, std::optional<mode_t> permissions = std::nullopt,
                       const std::string& shown = {});
  PendingFile(PendingFile&& other) noexcept;
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  void write(std::span<const std::byte> bytes);

  /// Replaces bytes that were written already.
  void overwrite(std::uint64_t offset, std::span<const std::byte> bytes);

  /// After the last byte: the file system has taken all of them. A file without a name keeps its descriptor.
  void close();

  /// After close(): gives up the descriptor, for a name beside `path`.
  void takeName();

  /// After close(). With `revocable`, the file that was there before is kept until this object ends.
  void moveIn(bool revocable = false);

  /// Puts back what moveIn(true) replaced, where the file system can.
  void moveOut() noexcept;

 private:
  enum class State : std::uint8_t { Open, Complete, Exchanged, Created, Replaced, Gone };

  [[noreturn]] void fail(int error) const;
  void openNamed(const std::filesystem::path& folder, mode_t mode);
  bool linkTo(const std::filesystem::path& path) const;
  void closeDescriptor();

  std::string shown_;                ///< in messages
  std::filesystem::path target_;     ///< without links
  std::filesystem::path temporary_;  ///< empty: it has no name; while Exchanged, what was there before
  int descriptor_ = -1;
  State state_ = State::Open;
};

/// Throws what PendingFile would say about a place that nothing can be written to: it makes a temporary there
/// and removes it. Removes what processes that were killed have left in the folder, too.
void checkWritable(const std::filesystem::path& path, const std::string& shown);

}  // namespace prelight
