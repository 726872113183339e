#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prelight {

/// Lower-case hexadecimal SHA-256.
std::string sha256(const std::string& text);

/// Compiled programs on disk, one file a key. An entry is used only when its header, key, length and checksum
/// are right; anything else counts as absent. Failing to write is never an error.
class ProgramCache {
 public:
  /// An empty folder switches the cache off.
  explicit ProgramCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// $XDG_CACHE_HOME/prelight/kernels, else ~/.cache/prelight/kernels; empty when neither is known.
  static std::filesystem::path defaultFolder();

  std::optional<std::vector<unsigned char>> load(const std::string& key) const;
  void store(const std::string& key, const std::vector<unsigned char>& binary) const;
  void remove(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace prelight
