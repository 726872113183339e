#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Adds the members `lightmap` to a document that embedBake has written to: where every primitive's vertices
/// lie in the picture `image`, a URI relative to the document.
void embedLightMap(GltfDocument& document, const CompiledScene& scene, const LightMapLayout& layout,
                   const std::string& image);

/// The light map's values as an .exr file: R, G, B are irradiance, W/m2, and sh.l0m0.R ... sh.l1m1.B, where
/// they are there, incident radiance; encoded.NAME.000 ... are the numbers of a texel in an encoding;
/// walls.right, walls.below and walls.inside, where there are walls, are LightMapLayout::walls. Writes beside
/// and renames.
void writeLightMap(const std::filesystem::path& path, const LightMap& map);

class OutputFiles;

/// Irradiance of its texels, W/m2.
Picture irradianceOf(const LightMap& map);

/// Adds the picture to files that are written together (base/atomic_file.h).
void addLightMap(OutputFiles& files, const std::filesystem::path& path, const LightMap& map);

/// Light map of a document, with its picture, which lies beside it; nullopt when it has none. Charts and the
/// texels' places are found anew from the texture coordinates. Throws InputError for coordinates and pictures
/// that do not fit.
std::optional<LightMap> readLightMap(const GltfDocument& document, const JsonCursor& root,
                                     const CompiledScene& scene);

/// Where a baked file's light map goes: "room.lightmap.exr" beside "room.glb".
std::filesystem::path lightMapPath(const std::filesystem::path& baked);

}  // namespace prelight
