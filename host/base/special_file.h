#pragma once

#include <filesystem>

namespace prelight {

/// Accepts regular files, folders and paths that do not exist. Throws InputError for pipes, sockets and
/// devices, which have no known end and may block for ever when opened.
void refuseSpecialFile(const std::filesystem::path& path);

}  // namespace prelight
