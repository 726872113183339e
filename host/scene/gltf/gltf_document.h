#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/error.h"

namespace prelight {

/// A glTF file made self-contained: one JSON tree and one binary chunk. Every buffer and image that the file
/// named by URI (external file or data URI) is embedded, so that the document can be written as a .glb as it
/// is. What was compressed is decoded, and the extensions that said so are gone.
struct GltfDocument {
  std::filesystem::path path;   ///< for messages, and for the files that it names
  bool outsideAllowed = false;  ///< ReadOptions::allowOutside
  nlohmann::ordered_json json;  ///< buffers[0] is `bin`; images refer to buffer views
  std::vector<std::uint8_t> bin;
};

struct ReadOptions {
  /// Files that the document names may lie outside of its folder. A scene from a stranger could have any file
  /// of the machine copied into what is written.
  bool allowOutside = false;
  /// What breaks a rule of glTF that nothing here depends on is a warning too.
  bool tellOddities = false;
};

/// Reads a .gltf or .glb, checks its structure (types, index ranges, accessors against buffers, node cycles,
/// required extensions) and embeds what it refers to. Throws InputError naming the file and the JSON path. A
/// missing or unreadable image is only a warning, and so is what is broken but not used.
GltfDocument readGltf(const std::filesystem::path& path, Warnings& warnings, const ReadOptions& options = {});

/// The same of a file's bytes. `path` is named in messages, and files are looked for beside it.
GltfDocument parseGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                       Warnings& warnings, const ReadOptions& options = {});

/// Writes a binary glTF beside `path` and renames it into place, so that a half-written file is never seen.
void writeGlb(const std::filesystem::path& path, const GltfDocument& document);

/// Appends an accessor over `data` (little-endian, tightly packed) in a buffer view of its own.
/// `type` is glTF's ("SCALAR", "VEC3", ...), `componentType` glTF's number (5126 float, 5125 uint32).
/// Returns the accessor's index.
int appendAccessor(GltfDocument& document, std::span<const std::byte> data, const std::string& type,
                   int componentType, std::size_t count);

}  // namespace prelight
