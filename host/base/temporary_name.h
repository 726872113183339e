#pragma once

#include <filesystem>
#include <string>

namespace prelight {

/// Returns a name for a temporary file of this process, a few dozen letters long, which identifies the
/// process and the machine.
std::string temporaryName(int number);

/// Removes temporary files in a folder that killed processes of this machine have left. Files that may still
/// be written, and those of other machines, are kept.
void removeAbandonedFiles(const std::filesystem::path& folder);

}  // namespace prelight
