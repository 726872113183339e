#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/device.h"

namespace prelight {

/// How a baked scene is handed on to other programs (docs/export.md).
struct ExportOptions {
  std::string target = "gltf";    ///< gltf, three, blender, raw, godot or unity
  std::string form = {};          ///< lightmap, occlusion, vertex-light, vertex-occlusion or volume; empty: a
                                  ///< light map, else occlusion, as the bake holds
  std::string lights = "remove";  ///< those whose light is baked: remove, mark or keep
  std::string name = {};          ///< that files of a folder begin with; empty: that of the scene's file
  bool dryRun = false;            ///< nothing is written
  std::uint32_t rays = 512;       ///< a texel of occlusion, 16 to 8192, rounded down to a power of two
  const Device* device = nullptr;  ///< that casts occlusion; nullptr: the default one, opened for the call
};

/// A file of an export.
struct WrittenFile {
  std::string name;
  std::string contents;  ///< for people
  std::uint64_t bytes = 0;
};

struct ExportResult {
  std::vector<WrittenFile> files = {};
  int mapWidth = 0;  ///< of the light map or the map of occlusion; 0: the form has none
  int mapHeight = 0;
};

/// Writes an ordinary glTF scene with what was baked: `output` is a .glb, which holds all of it, or a folder,
/// made where its last part is missing. All files appear together. Throws UsageError for unknown names and
/// for a form that the bake holds nothing for, Error for a file that cannot be written.
ExportResult exportScene(const std::filesystem::path& output, const LoadedScene& scene, const Bake& bake,
                         const ExportOptions& options = {});

}  // namespace prelight
