#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "prelight/transfer.h"

namespace prelight {

/// How saved data is compressed (docs/notes/compression.md).
struct FileCompression {
  /// Compression of SH transfer at vertices, texels, keys and points in the air.
  std::optional<CompressionRequest> transfer = {};
  bool occluders = false;  ///< quantises vector occluders
  /// Makes all numbers of vertices small: SH transfer by `transfer`, or else by whichever of `band8` and
  /// `rgbe` has the smaller error; glossy matrices by principal components; vector occluders as whole
  /// numbers; and every other column as bytes.
  bool everything = false;

  bool any() const { return transfer || occluders || everything; }
};

/// Parses "auto" (everything), "auto:METHOD" (everything, and SH transfer by that method) or a METHOD of
/// parseCompression(). Throws UsageError.
FileCompression parseFileCompression(std::string_view text);

/// Writes as save() does, compressed. Returns messages about sizes and errors. Throws as save() does, and
/// UsageError where the bake has no SH transfer for `transfer` or no vector occluders for `occluders`.
std::vector<std::string> saveCompressed(const std::filesystem::path& path, const LoadedScene& scene,
                                        const Bake& bake, const FileCompression& compression);

}  // namespace prelight
