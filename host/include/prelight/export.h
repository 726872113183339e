#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/device.h"

namespace prelight {

/// How a baked scene is exported for other programs (docs/notes/export.md).
struct ExportOptions {
  std::string target = "gltf";  ///< gltf, three, blender, raw, godot or unity
  /// One of lightmap, occlusion, vertex-light, vertex-occlusion, volume or transfer (for three and raw);
  /// empty: a light map if the bake holds one, else occlusion, but for three transfer that prelight.js
  /// relights first.
  std::string form = {};
  std::string lights = "remove";  ///< how lights whose light is baked are exported: remove, mark or keep
  std::string name = {};  ///< prefix of the names of a folder's files; empty: the name of the scene's file
  bool dryRun = false;    ///< lists the files without writing them
  /// Rays per texel of an occlusion map, 16 to 8192, rounded down to a power of two.
  std::uint32_t rays = 512;
  /// Device that casts occlusion; nullptr: the default one, opened for the call.
  const Device* device = nullptr;
};

/// A file that an export writes.
struct WrittenFile {
  std::string name;
  std::string contents;  ///< description for messages
  std::uint64_t bytes = 0;
};

/// The files of an export and the size of its map.
struct ExportResult {
  std::vector<WrittenFile> files = {};
  int mapWidth = 0;  ///< texels of the light map or occlusion map; 0: the form has none
  int mapHeight = 0;
};

/// Writes an ordinary glTF scene with baked light. `output` is a .glb, which holds everything, or a folder,
/// whose last component is created if missing. All files appear together or not at all. Throws UsageError for
/// unknown names and for a form for which the bake holds nothing, and Error for a file that cannot be
/// written.
ExportResult exportScene(const std::filesystem::path& output, const LoadedScene& scene, const Bake& bake,
                         const ExportOptions& options = {});

}  // namespace prelight
