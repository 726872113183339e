#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace prelight {

/// A file for what memory has no room for. It lies in the folder that the environment variable TMPDIR names, else in
/// /var/tmp, has no name there, and is gone with the object, however that ends. What was never written reads as 0.
///
/// All but the destructor throw Error (RuntimeFailure) where the folder or the disk refuses.
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
