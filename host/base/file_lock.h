#pragma once

#include <filesystem>

namespace prelight {

/// Locks an open file for this process, until it closes the file or ends. Returns false if another process
/// has the lock; file systems without locks refuse nobody.
bool lockFile(int descriptor);

/// Returns true if another process has locked a file.
bool isLockedByAnother(const std::filesystem::path& path);

/// Removes a file, if there is one, unless another process has locked it.
void removeUnlessLocked(const std::filesystem::path& path);

}  // namespace prelight
