#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "prelight/error.h"

namespace prelight {

/// A self-contained glTF file: one JSON tree and one binary chunk. Every buffer and image that the file named
/// by URI (external file or data URI) is embedded, so that the document can be written as a .glb directly.
/// Compressed data is decoded, and its extensions are removed.
struct GltfDocument {
  std::filesystem::path path;   ///< for messages, and for the files that the document names
  bool outsideAllowed = false;  ///< ReadOptions::allowOutside
  nlohmann::ordered_json json;  ///< buffers[0] is `bin`; images refer to buffer views
  std::vector<std::uint8_t> bin;
};

/// Options of readGltf() and parseGltf().
struct ReadOptions {
  /// Permits files outside the document's folder. Otherwise a scene from a stranger could have any file of
  /// the machine copied into the output.
  bool allowOutside = false;
  /// Also warns of violations of rules of glTF on which nothing here depends.
  bool tellOddities = false;
};

/// Reads a .gltf or .glb, checks its structure (types, index ranges, accessors against buffers, node cycles,
/// required extensions) and embeds what it refers to. Throws InputError naming the file and the JSON path. A
/// missing or unreadable image is only a warning, and so is what is broken but not used.
GltfDocument readGltf(const std::filesystem::path& path, Warnings& warnings, const ReadOptions& options = {});

/// As readGltf, for the bytes of a file. `path` is named in messages, and files are looked for beside it.
GltfDocument parseGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                       Warnings& warnings, const ReadOptions& options = {});

/// Writes a binary glTF beside `path` and renames it into place, so that a half-written file is never seen.
void writeGlb(const std::filesystem::path& path, const GltfDocument& document);

/// Appends an accessor over `data` (little-endian, tightly packed) in a buffer view of its own.
/// `type` is glTF's ("SCALAR", "VEC3", ...), `componentType` glTF's number (5126 float, 5125 uint32).
/// Returns the accessor's index.
int appendAccessor(GltfDocument& document, std::span<const std::byte> data, const std::string& type,
                   int componentType, std::size_t count);

/// Returns the size in bytes of the file that writeGlb() makes.
std::uint64_t glbSize(const GltfDocument& document);

/// Adds the file that writeGlb() would write to a set of files that are written together.
void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document);

/// Adds a name to `extensionsUsed` of a glTF object, unless it is listed already.
void useExtensionName(nlohmann::ordered_json& root, std::string_view name);

/// Removes a name from `extensionsUsed` and `extensionsRequired`.
void dropExtensionName(nlohmann::ordered_json& root, std::string_view name);

}  // namespace prelight
