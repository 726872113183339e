#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace prelight::cli {

/// Throws unless a file can be written at `path`, so that a typing error does not cost hours of work.
/// `option` is the option that set the path; without extensions, any will do. A wrong extension is a
/// UsageError, everything else an Error(RuntimeFailure).
void checkOutputFile(const std::string& option, const std::filesystem::path& path,
                     std::initializer_list<std::string_view> extensions);

/// Checks a folder in this way; the last part of its path need not exist.
void checkOutputFolder(const std::string& option, const std::filesystem::path& path);

/// Makes a folder that has been checked, unless it exists.
void makeOutputFolder(const std::string& option, const std::filesystem::path& path);

/// Writes a temporary file beside `path` and renames it.
void writeTextFile(const std::filesystem::path& path, const std::string& text);

}  // namespace prelight::cli
