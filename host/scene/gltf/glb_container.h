#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/error.h"

namespace prelight {

/// The two chunks of a binary glTF file, as views into its bytes.
struct GlbChunks {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> bin;
};

/// True when the bytes start with the magic of a binary glTF file.
bool isGlb(std::span<const std::uint8_t> bytes);

/// Splits a binary glTF 2 file. Throws InputError naming `file` when its header or chunk lengths are wrong;
/// bytes after its end are a warning.
GlbChunks splitGlb(std::span<const std::uint8_t> bytes, const std::string& file, Warnings& warnings);

/// Returns the header, the JSON chunk and the header of the binary chunk (when `binBytes` > 0) of a file; the
/// binary data, padded to 4 bytes, must follow. Throws Error when the file would be longer than the format's
/// 4 GiB.
std::vector<std::uint8_t> makeGlbPrefix(std::string json, std::size_t binBytes, const std::string& file);

}  // namespace prelight
