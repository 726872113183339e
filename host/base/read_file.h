#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace prelight {

/// Returns at most `limit` bytes of a regular file. Throws InputError if it does not exist or cannot be read.
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& path, const std::string& where,
                                        std::uint64_t limit = UINT64_MAX);

}  // namespace prelight
