#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace prelight {

/// Reads at most `limit` bytes of a regular file. Throws InputError when there is none or it cannot be read.
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& path, const std::string& where,
                                        std::uint64_t limit = UINT64_MAX);

}  // namespace prelight
