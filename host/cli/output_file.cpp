#include "cli/output_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <system_error>

#include "base/atomic_file.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseOutput(const std::string& option, const fs::path& path, const std::string& what,
                               const std::string& fix) {
  throw Error(ExitCode::RuntimeFailure, fmt::format("{} {}", option, path.string()), what, fix);
}

std::string lowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void checkFolder(const std::string& option, const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    refuseOutput(option, path, fmt::format("the folder {} does not exist", folder.string()),
                 "make it, or name another");
}

}  // namespace

void checkOutputFile(const std::string& option, const fs::path& path,
                     std::initializer_list<std::string_view> extensions) {
  const std::string extension = lowerExtension(path);
  if (extensions.size() > 0 && std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw UsageError(option, fmt::format("got '{}', expected a file name that ends in {}", path.string(),
                                         fmt::join(extensions, " or ")));
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) refuseOutput(option, path, "is a folder", "name a file");
  checkFolder(option, path, folderOf(path));
  checkWritable(path, fmt::format("{} {}", option, path.string()));
}

void checkOutputFolder(const std::string& option, const fs::path& path) {
  std::error_code ignored;
  const std::string shown = fmt::format("{} {}", option, path.string());
  if (fs::is_directory(path, ignored)) return checkWritable(path / "file", shown);
  if (fs::exists(path, ignored)) refuseOutput(option, path, "is not a folder", "name a folder");
  const fs::path made = path.has_filename() ? path : path.parent_path();  // without a slash at its end
  checkFolder(option, path, folderOf(made));
  checkWritable(made, shown);
}

void makeOutputFolder(const std::string& option, const fs::path& path) {
  std::error_code error;
  fs::create_directory(path, error);
  if (error)
    refuseOutput(option, path, fmt::format("cannot be made: {}", error.message()),
                 "name a folder that exists");
}

void writeTextFile(const fs::path& path, const std::string& text) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  writeFileAtomically(path, std::span(&bytes, 1));
}

}  // namespace prelight::cli
