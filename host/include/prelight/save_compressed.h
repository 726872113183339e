#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/transfer.h"

namespace prelight {

/// How what is written is made smaller (docs/compression.md).
struct FileCompression {
  std::optional<CompressionRequest> transfer =
      {};                  ///< of SH, at vertices, texels, keys and points in the air
  bool occluders = false;  ///< vector occluders in whole numbers
};

/// The same as save(), smaller. Returns what that changed, for people. Throws as save(), and UsageError where
/// the bake has nothing to compress.
std::vector<std::string> saveCompressed(const std::filesystem::path& path, const LoadedScene& scene,
                                        const Bake& bake, const FileCompression& compression);

}  // namespace prelight
