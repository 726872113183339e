#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace prelight {

/// Accepts regular files, folders and paths that do not exist. Throws InputError for pipes, sockets and
/// devices, which have no known end and may block for ever when opened.
void refuseSpecialFile(const std::filesystem::path& path);

/// Returns at most `limit` bytes of a regular file. Throws InputError if it does not exist or cannot be read.
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& path, const std::string& where,
                                        std::uint64_t limit = UINT64_MAX);

}  // namespace prelight
