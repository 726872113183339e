#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/transfer.h"

namespace prelight {

/// How saved data is compressed (docs/notes/compression.md).
struct FileCompression {
  /// Compression of SH transfer at vertices, texels, keys and points in the air.
  std::optional<CompressionRequest> transfer = {};
  bool occluders = false;  ///< quantises vector occluders
};

/// Writes as save() does, compressed. Returns messages about sizes and errors. Throws as save() does, and
/// UsageError where the bake holds nothing to compress.
std::vector<std::string> saveCompressed(const std::filesystem::path& path, const LoadedScene& scene,
                                        const Bake& bake, const FileCompression& compression);

}  // namespace prelight
