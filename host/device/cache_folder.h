#pragma once

#include <filesystem>
#include <optional>
#include <string>

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

}  // namespace prelight
