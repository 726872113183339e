#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prelight {

/// Returns why compiled programs in a folder must not be run: the folder or its parent belongs to another
/// user or is writable by others. Returns nothing if the folder may be used or does not exist yet.
std::optional<std::string> refusalOfCache(const std::filesystem::path& folder);

/// Creates the missing folders of a path with access for the owner alone. Returns false on failure.
bool makePrivateFolders(const std::filesystem::path& folder);

/// Returns the bytes of a file if it belongs to this user, is not writable by others and is no link; else
/// nothing.
std::optional<std::string> readOwnFile(const std::filesystem::path& path);

/// Writes a temporary file beside `path`, with access for the owner alone, and renames it. Returns false on
/// failure and leaves no file then.
bool writeOwnFile(const std::filesystem::path& path, const std::string& bytes);

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
