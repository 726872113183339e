#pragma once

#include <filesystem>

namespace prelight {

/// Throws InputError for a pipe, a socket or a device, whose end nobody knows: opening one may wait for ever.
/// What is not there, a folder and a file pass.
void refuseSpecialFile(const std::filesystem::path& path);

}  // namespace prelight
