#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace prelight::cli {

/// Throws unless a file can be written at `path`, so that hours of work are not lost to a typing error.
/// `option` is what the user gave the path to. A wrong extension is a UsageError, the rest an
/// Error(RuntimeFailure).
void checkOutputFile(const std::string& option, const std::filesystem::path& path,
                     std::initializer_list<std::string_view> extensions);

/// Checks a folder likewise; its last part may be missing.
void checkOutputFolder(const std::string& option, const std::filesystem::path& path);

/// Makes one that has been checked, unless it is there.
void makeOutputFolder(const std::string& option, const std::filesystem::path& path);

/// Writes beside `path` and renames into place.
void writeTextFile(const std::filesystem::path& path, const std::string& text);

}  // namespace prelight::cli
