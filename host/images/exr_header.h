#pragma once

#include <filesystem>

namespace prelight {

/// Throws InputError naming the file when the headers of an OpenEXR file are broken or claim more than a file
/// of its size can hold: bytes of an attribute, chunks in the tables of offsets, or numbers in the pixels.
/// The library allocates what they claim before it finds out.
void checkExrHeaders(const std::filesystem::path& path);

}  // namespace prelight
