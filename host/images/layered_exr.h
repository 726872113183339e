#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// One part of an .exr file of several.
struct ExrPart {
  std::string name;
  std::vector<std::string> channels;  ///< their names
  std::span<const float> values;      ///< [row][column][channel]
};

/// Bytes of an .exr file of parts of one size, compressed. Equal pictures are equal files. Throws Error about
/// `shown`.
std::vector<std::byte> encodeLayeredExr(const std::filesystem::path& shown, int width, int height,
                                        std::span<const ExrPart> parts);

}  // namespace prelight
