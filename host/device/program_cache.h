#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prelight {

/// Returns the SHA-256 of a text in lower-case hexadecimal digits.
std::string sha256(const std::string& text);

/// Compiled programs on disk, one file per key. Entries with a wrong header, key, length or checksum count as
/// absent. Failing to write is not an error.
class ProgramCache {
 public:
  /// Uses a folder; an empty path disables the cache.
  explicit ProgramCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns $XDG_CACHE_HOME/prelight/kernels, else ~/.cache/prelight/kernels, or an empty path when neither
  /// is known.
  static std::filesystem::path defaultFolder();

  std::optional<std::vector<unsigned char>> load(const std::string& key) const;
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;
  void remove(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace prelight
