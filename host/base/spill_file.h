#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace prelight {

/// A file for data that does not fit in memory. It lies in the folder of the environment variable TMPDIR,
/// otherwise in /var/tmp, has no name there, and disappears with the object, however the process ends. Bytes
/// that were never written read as 0.
///
/// All functions except the destructor throw Error (RuntimeFailure) if the folder or the disk refuses.
class SpillFile {
 public:
  SpillFile();
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  void write(std::uint64_t offset, std::span<const std::byte> bytes);

  /// Fills `bytes` from `offset` on.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  [[noreturn]] void fail(const char* what, int error) const;

  std::string folder_;
  int descriptor_ = -1;
};

}  // namespace prelight
