#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/scene.h"

namespace prelight {

struct GltfDocument;

/// A scene as it was read, in the forms that the library's functions take. Copies share the file.
struct LoadedScene {
  Scene scene;  ///< what the file says, in its own shapes
  CompiledScene
      compiled;       ///< the same in flat arrays; compileScene() makes them anew after a change to `scene`
  Warnings warnings;  ///< what was odd but usable
  std::filesystem::path path;                    ///< of the file, for messages
  std::shared_ptr<const GltfDocument> document;  ///< the file itself, for save()
  std::shared_ptr<const Environment> sky = {};   ///< EXT_lights_image_based's; nullptr: the file has none
};

/// A measured BRDF for a material.
struct MaterialBrdf {
  std::string material;        ///< name, or number in the file
  std::filesystem::path file;  ///< in MERL's binary format
};

struct LoadOptions {
  /// Files that the scene names may lie outside of its folder. A scene from a stranger could have any file of
  /// the machine copied into what is saved.
  bool allowOutside = false;
  std::string scene = {};    ///< name or number; empty: the file's default scene
  std::string variant = {};  ///< of the materials (KHR_materials_variants); empty: what was baked, or none
  std::optional<double> at = {};  ///< s, moment to pose the scene at; none: what was baked, or rest
  /// Makes the scene so many times as large, > 0 and finite: 0.001 for a file in millimetres. What save()
  /// writes is as large, and what was baked of the file in its own size is left out.
  double scale = 1.0;
  std::string animation = {};            ///< name or number of the one that has the moment; empty: the first
  std::vector<MaterialBrdf> brdfs = {};  ///< take the place of what the file says of these materials
};

/// Reads a .gltf or .glb with all that it names. Throws InputError naming the file and the JSON path of what
/// cannot be used; images that are missing or broken are warnings. Throws UsageError for a scene, a variant
/// or an animation that the file lacks. A scene other than the default is the default of what save() writes.
LoadedScene load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Reads the bytes of a .gltf or .glb. Files that it names are looked for in `folder`; empty: the current
/// one.
LoadedScene load(std::span<const std::byte> bytes, const std::filesystem::path& folder = {},
                 const LoadOptions& options = {});

/// Name and one-line description of a built-in scene.
struct BuiltinScene {
  std::string name;
  std::string description;
};

const std::vector<BuiltinScene>& builtinScenes();

/// A built-in scene with a camera and a light. Throws UsageError for an unknown name, listing the known ones.
LoadedScene loadBuiltin(const std::string& name);

/// What a scene's file carries of an earlier bake; nothing when it was not baked. Throws InputError when that
/// does not fit the scene.
std::optional<Bake> carriedBake(const LoadedScene& scene);

/// Writes a scene's file as a .glb with a bake in place of an earlier one (docs/file-format.md), and its
/// light map, if there is one, beside it as NAME.lightmap.exr. Files appear whole or not at all. The bake
/// must be of the scene as the file has it. Throws UsageError for another extension than .glb, Error for a
/// bake that is not finite or a file that cannot be written.
void save(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake);

/// The same without a bake: plain glTF. An earlier bake is left out.
void save(const std::filesystem::path& path, const LoadedScene& scene);

}  // namespace prelight
