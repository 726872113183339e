#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace prelight {

/// Why what lies in a folder of compiled programs must not be run: it, or the folder that it is in, belongs
/// to somebody else or can be written to by others. Nothing where it may be used, and where it is not there
/// yet.
std::optional<std::string> refusalOfCache(const std::filesystem::path& folder);

/// Makes what is missing of a path, for its owner alone. False when that fails.
bool makePrivateFolders(const std::filesystem::path& folder);

/// The bytes of a file that nobody else can have written: of this user, not to be written by others, and no
/// link.
std::optional<std::string> readOwnFile(const std::filesystem::path& path);

/// Writes beside `path`, for its owner alone, and renames. False when that fails; nothing is left of it then.
bool writeOwnFile(const std::filesystem::path& path, const std::string& bytes);

}  // namespace prelight
