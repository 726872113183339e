#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Hashes vertices, and triangles with their materials.
void addGeometry(const CompiledScene& scene, StateHash& hash);

/// Hashes the material properties that all bakes read.
void addMaterials(const CompiledScene& scene, StateHash& hash);

/// Parts of a scene that baked values depend on, besides geometry and the holes of surfaces.
struct BakeSubject {
  bool colors = false;      ///< colours of surfaces
  bool scattering = false;  ///< all properties of materials
  bool lights = false;      ///< the scene's own lights
};

/// Returns the parts that a bake depends on.
BakeSubject subjectOf(const Bake& bake, std::size_t vertices);

/// Returns hashes of the parts that the baked values depend on, by which a baked file later detects changes
/// of its scene (docs/file-format.md).
nlohmann::ordered_json fingerprintOf(const GltfDocument& document, const CompiledScene& scene,
                                     const BakeSubject& subject);

/// Differences between a scene and the baked one.
struct StaleScene {
  std::vector<std::string> parts;       ///< any of "geometry", "materials", "textures" and "lights"
  std::vector<std::string> stale = {};  ///< techniques whose values no longer fit
  bool all = false;                     ///< whether these are all techniques in the file
};

/// A baked scene in its present state.
struct BakedScene {
  const GltfDocument& document;
  const Scene& scene;
  const CompiledScene& compiled;
  const Bake& bake;
};

/// Returns what has changed in a scene since it was baked, as far as `used` parts of the bake depend on it.
/// Returns nothing if there are no changes, if the file does not tell (earlier versions wrote no or
/// incomplete fingerprints), or if the scene is deliberately posed differently.
std::optional<StaleScene> changedSinceBake(const BakedScene& baked, BakeSubject used);

/// Returns what has changed for everything that the bake holds.
std::optional<StaleScene> changedSinceBake(const BakedScene& baked);

/// Returns a message such as "the scene's lights changed after it was baked: what it carries does not fit
/// it".
std::string textOf(const StaleScene& change);

}  // namespace prelight
