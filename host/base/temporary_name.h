#pragma once

#include <filesystem>
#include <string>

namespace prelight {

/// A name for a temporary file of this process, of a few dozen letters: it tells which process of which
/// machine made it.
std::string temporaryName(int number);

/// Removes temporary files that processes of this machine left in a folder when they were killed. Those that
/// may still be written, and those of other machines, stay.
void removeAbandonedFiles(const std::filesystem::path& folder);

}  // namespace prelight
