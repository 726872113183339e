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
  Scene scene;  ///< the content of the file, in object space
  /// Content of `scene` in flat arrays; compileScene() makes it anew after a change to `scene`.
  CompiledScene compiled;
  Warnings warnings;                             ///< odd but usable parts of the file
  std::filesystem::path path;                    ///< path of the file, for messages
  std::shared_ptr<const GltfDocument> document;  ///< the file itself, for save()
  std::shared_ptr<const Environment> sky = {};  ///< sky of EXT_lights_image_based; nullptr: the file has none
  double refined =
      0.0;  ///< RefineRequest::error of the last refine(); 0: none, or of what the file was before
};

/// Assigns a measured BRDF to a material.
struct MaterialBrdf {
  std::string material;        ///< name of the material, or its number in the file
  std::filesystem::path file;  ///< in MERL's binary format
};

/// Options of load().
struct LoadOptions {
  /// Allows files that the scene names to lie outside its folder. With a scene from a stranger this could
  /// copy any file of the machine into what is saved.
  bool allowOutside = false;
  std::string scene = {};  ///< name or number of the scene; empty: the file's default scene
  /// Material variant (KHR_materials_variants); empty: the one that was baked, or none.
  std::string variant = {};
  /// Moment, in seconds, at which the scene is posed; none: the one that was baked, or rest.
  std::optional<double> at = {};
  /// Factor, > 0 and finite, that scales the scene: 0.001 for a file in millimetres. save() writes the scaled
  /// scene without a bake that the file carries at its own size.
  double scale = 1.0;
  std::string animation = {};  ///< name or number of the animation that `at` refers to; empty: the first
  std::vector<MaterialBrdf> brdfs = {};  ///< BRDFs that replace the file's materials
};

/// Reads a .gltf or .glb and the files that it names. Throws InputError with the file and the JSON path of
/// content that cannot be used; missing or broken images only give warnings. Throws UsageError for a scene,
/// variant or animation that the file lacks. The chosen scene becomes the default scene of files that save()
/// writes.
LoadedScene load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Reads the bytes of a .gltf or .glb. Files that it names are looked for in `folder`, or in the current
/// folder if that is empty.
LoadedScene load(std::span<const std::byte> bytes, const std::filesystem::path& folder = {},
                 const LoadOptions& options = {});

/// Name and one-line description of a built-in scene.
struct BuiltinScene {
  std::string name;
  std::string description;
};

const std::vector<BuiltinScene>& builtinScenes();

/// Returns a built-in scene with a camera and a light. Throws UsageError that lists the known names for an
/// unknown one.
LoadedScene loadBuiltin(const std::string& name);

/// Returns the earlier bake that a scene's file carries, or nothing if it was not baked. Throws InputError
/// when the bake does not fit the scene.
std::optional<Bake> carriedBake(const LoadedScene& scene);

/// Writes a scene's file as a .glb with a bake, which replaces an earlier one (docs/file-format.md), and
/// beside it the light map, if there is one, as NAME.lightmap.exr. Files appear whole or not at all. The bake
/// must belong to the scene as the file has it. Throws UsageError for another extension than .glb, and Error
/// for a bake that is not finite or a file that cannot be written.
void save(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake);

/// Writes a scene's file as a plain .glb without any bake. Throws as above.
void save(const std::filesystem::path& path, const LoadedScene& scene);

}  // namespace prelight
