#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace prelight {

/// Lets `write` make a file under a temporary name beside `path` (same folder and extension), then renames it
/// to `path`: nobody ever sees half a file. The temporary is removed when `write` throws. A symbolic link is
/// followed; a device or pipe, which cannot be replaced, is handed to `write` as it is. Throws Error
/// (RuntimeFailure) "cannot write ..." when the file cannot be made or renamed.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for bytes, one piece after the other.
void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces);

}  // namespace prelight
