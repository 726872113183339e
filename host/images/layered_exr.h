#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// One part of a multi-part .exr file.
struct ExrPart {
  std::string name;
  std::vector<std::string> channels;  ///< names of the channels
  std::span<const float> values;      ///< [row][column][channel]
};

/// Encodes a compressed .exr file whose parts have one size. Equal pictures give equal bytes. Throws Error
/// about `shown`.
std::vector<std::byte> encodeLayeredExr(const std::filesystem::path& shown, int width, int height,
                                        std::span<const ExrPart> parts);

}  // namespace prelight
